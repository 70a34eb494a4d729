#include "doctor/echo_topics.h"

namespace understudy::doctor {
namespace {

template <class Message>
void PutBySn(const Mark& mark, Message* message) {
  message->sn[0] = mark.session;
  message->sn[1] = mark.target;
  message->crc = mark.number;
}

template <class Message>
void PutByReserve(const Mark& mark, Message* message) {
  message->reserve[0] = mark.session;
  message->reserve[1] = mark.target;
  message->crc = mark.number;
}

template <class Message>
Mark BySn(const Message& message) {
  return {.session = message.sn[0], .target = message.sn[1], .number = message.crc};
}

template <class Message>
Mark ByReserve(const Message& message) {
  return {.session = message.reserve[0], .target = message.reserve[1], .number = message.crc};
}

constexpr unsigned kWord = 32;

template <class Message>
void PutVersion(std::int64_t time, Message* message) {
  const auto bits = static_cast<std::uint64_t>(time);
  message->version[0] = static_cast<std::uint32_t>(bits);
  message->version[1] = static_cast<std::uint32_t>(bits >> kWord);
}

template <class Message>
std::int64_t ByVersion(const Message& message) {
  return static_cast<std::int64_t>(std::uint64_t{message.version[1]} << kWord | message.version[0]);
}

}  // namespace

void PutTime(std::int64_t time, GoEcho::Pong* message) { PutVersion(time, message); }
void PutTime(std::int64_t time, HgEcho::Pong* message) { PutVersion(time, message); }
std::int64_t TimeOf(const GoEcho::Pong& message) { return ByVersion(message); }
std::int64_t TimeOf(const HgEcho::Pong& message) { return ByVersion(message); }

// FNV-1a.
std::uint32_t TagOf(const bus::ParticipantKey& participant) {
  std::uint32_t tag = 2166136261U;
  for (const std::uint8_t byte : participant) tag = (tag ^ byte) * 16777619U;
  return tag;
}

void Put(const Mark& mark, GoEcho::Ping* message) { PutBySn(mark, message); }
void Put(const Mark& mark, GoEcho::Pong* message) { PutBySn(mark, message); }
void Put(const Mark& mark, HgEcho::Ping* message) { PutByReserve(mark, message); }
void Put(const Mark& mark, HgEcho::Pong* message) { PutByReserve(mark, message); }
Mark MarkOf(const GoEcho::Ping& message) { return BySn(message); }
Mark MarkOf(const GoEcho::Pong& message) { return BySn(message); }
Mark MarkOf(const HgEcho::Ping& message) { return ByReserve(message); }
Mark MarkOf(const HgEcho::Pong& message) { return ByReserve(message); }

}  // namespace understudy::doctor
