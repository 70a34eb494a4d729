#include "viewer/request_sender.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "client/client.h"
#include "viewer/screen_text.h"

namespace understudy::viewer {
namespace {

using nlohmann::json;

constexpr std::chrono::milliseconds kAnswerPatience{5'000};
constexpr std::chrono::seconds kStatusPeriod{1};

}  // namespace

RequestSender::RequestSender(const std::filesystem::path& socket)
    : thread_([this, socket](const std::stop_token& stop) { Run(stop, socket); }) {}

void RequestSender::Send(const std::string& name, const json& values) {
  {
    const std::lock_guard lock(mutex_);
    // Only the newest place of a drag counts.
    if (name == "drag") {
      std::erase_if(waiting_, [&](const Request& waiting) { return waiting.name == name; });
    }
    waiting_.push_back({name, values});
  }
  news_.notify_one();
}

std::string RequestSender::TakeRefusal() {
  const std::lock_guard lock(mutex_);
  return std::exchange(refusal_, {});
}

std::string RequestSender::motors() const {
  const std::lock_guard lock(mutex_);
  return motors_;
}

void RequestSender::Run(const std::stop_token& stop, const std::filesystem::path& socket) {
  while (!stop.stop_requested()) {
    try {
      Serve(stop, socket);
    } catch (const ControlError& error) {
      std::unique_lock lock(mutex_);
      if (!waiting_.empty()) refusal_ = error.what();
      waiting_.clear();
      news_.wait_for(lock, stop, kStatusPeriod, [] { return false; });  // then once more
    }
  }
}

void RequestSender::Serve(const std::stop_token& stop, const std::filesystem::path& socket) {
  client::ControlStream stream(socket, "/requests", kAnswerPatience);
  auto ask_at = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    std::optional<Request> request;
    {
      std::unique_lock lock(mutex_);
      news_.wait_until(lock, stop, ask_at, [this] { return !waiting_.empty(); });
      if (!waiting_.empty()) {
        request = std::move(waiting_.front());
        waiting_.pop_front();
      }
    }
    if (request) {
      stream.Send(json{{request->name, request->values}}.dump());
      const json answer = json::parse(stream.Next(), nullptr, false);
      if (answer.is_object() && answer.contains("error") && answer["error"].is_string()) {
        const std::lock_guard lock(mutex_);
        refusal_ = answer["error"];
      }
    }
    if (std::chrono::steady_clock::now() >= ask_at) {
      AskStatus(socket);
      ask_at = std::chrono::steady_clock::now() + kStatusPeriod;
    }
  }
}

void RequestSender::AskStatus(const std::filesystem::path& socket) {
  const json status =
      json::parse(client::Call(socket, "GET", "/status", "", kAnswerPatience).body, nullptr, false);
  const std::lock_guard lock(mutex_);
  motors_ = MotorsText(status);
}

}  // namespace understudy::viewer
