#include "record/truth_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/errors.h"

namespace understudy::record {
namespace {

constexpr std::uint64_t kSecond = 1'000'000'000;  // ns
constexpr double kLongest = 1e9;                  // s; what says more is damaged

Truth Decode(const McapMessage& message) {
  Truth truth = DecodeTruth(message.data);
  if (truth.time >= 0 && truth.time <= kLongest) return truth;
  throw RecordError("a state of second " + std::to_string(truth.time));
}

}  // namespace

TruthReader::TruthReader(const std::filesystem::path& file) : reader_(file) {
  bool found = false;
  reader_.ReadMessages([&](const McapChannel& channel, const McapMessage& message) {
    if (channel.topic != kTruthTopic) return true;
    whole_.from = Decode(message).time;
    origin_ = message.log_time - static_cast<std::uint64_t>(whole_.from * kSecond);
    found = true;
    return false;
  });
  if (!found) {
    throw RecordError(file.string() + ": no messages on " + kTruthTopic +
                      ", which `understudy run --record` writes");
  }
  whole_.to = whole_.from;
  const std::uint64_t end = reader_.contents().last_time;
  reader_.ReadMessages(end - std::min(end, static_cast<std::uint64_t>(kLookBack * kSecond)), end,
                       [&](const McapChannel& channel, const McapMessage& message) {
                         if (channel.topic == kTruthTopic) {
                           whole_.to = std::max(whole_.to, Decode(message).time);
                         }
                         return true;
                       });
}

std::uint64_t TruthReader::LogTime(double time) const {
  return origin_ + static_cast<std::uint64_t>(std::llround(std::max(time, 0.0) * kSecond));
}

void TruthReader::Read(const Span& span, std::size_t nq, const Visit& visit, const Tell& tell,
                       double before) const {
  const std::uint64_t from = LogTime(span.from);
  reader_.ReadMessages(LogTime(span.from - before), LogTime(span.to),
                       [&](const McapChannel& channel, const McapMessage& message) {
                         if (tell && channel.topic == kEventTopic) tell(DecodeEvent(message.data));
                         if (channel.topic != kTruthTopic || message.log_time < from) return true;
                         Truth truth = Decode(message);
                         if (truth.qpos.size() != nq) {
                           throw RecordError("a state of " + std::to_string(truth.qpos.size()) +
                                             " positions, its model has " + std::to_string(nq));
                         }
                         return visit(std::move(truth));
                       });
}

}  // namespace understudy::record
