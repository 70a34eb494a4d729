#include "viewer/live_robot.h"

#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "client/client.h"
#include "mjcf/compile.h"
#include "record/truth.h"

namespace understudy::viewer {
namespace {

constexpr std::chrono::milliseconds kPatience{10'000};  // a robot under a debugger is soon gone
constexpr std::size_t kSecondsKept = 60;

const std::string kParts = "?parts=qpos,contacts,pushes,crane,remote";

std::string Get(const std::filesystem::path& socket, const std::string& path) {
  client::ControlReply reply = client::Call(socket, "GET", path, "", kPatience);
  if (reply.status != 200) {
    throw ControlError("the robot at " + socket.string() + " does not answer " + path +
                       " (HTTP status " + std::to_string(reply.status) + ")");
  }
  return std::move(reply.body);
}

}  // namespace

mjcf::ModelHandle FetchModel(const std::filesystem::path& socket) {
  return mjcf::ReadBinaryModel(Get(socket, "/scene/model"), "the robot's model");
}

std::string FetchName(const std::filesystem::path& socket) {
  const nlohmann::json status = nlohmann::json::parse(Get(socket, "/status"), nullptr, false);
  return status.is_object() ? status.value("name", std::string()) : std::string();
}

SceneState FetchState(const std::filesystem::path& socket, std::size_t nq) {
  return ReadSnapshot(Get(socket, "/snapshot" + kParts), nq);
}

LiveEvents::LiveEvents(std::filesystem::path socket) : socket_(std::move(socket)) {}

std::vector<FilmEvent> LiveEvents::News() {
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_ < kPatience) return {};
  asked_ = now;
  std::vector<FilmEvent> news;
  try {
    const nlohmann::json told = nlohmann::json::parse(Get(socket_, "/events"));
    for (const nlohmann::json& one : told.at("events")) {
      const auto number = one.at("number").get<std::int64_t>();
      if (number < next_) continue;
      next_ = number + 1;
      if (!record::IsForPictures(one.at("kind").get<std::string>())) continue;
      news.push_back(
          {.time = one.at("time").get<double>(), .text = one.at("text").get<std::string>()});
    }
  } catch (const ControlError&) {
    // It has gone, which its states tell.
  } catch (const nlohmann::json::exception&) {
    // What it says is none of ours.
  }
  return news;
}

LiveRobot::LiveRobot(const std::filesystem::path& socket, int hz, std::size_t nq,
                     std::function<void()> on_news)
    : hz_(hz),
      nq_(nq),
      on_news_(std::move(on_news)),
      thread_([this, socket](const std::stop_token& stop) { Receive(stop, socket); }) {}

void LiveRobot::Receive(const std::stop_token& stop, const std::filesystem::path& socket) {
  try {
    client::ControlStream stream(socket, "/snapshots" + kParts + "&hz=" + std::to_string(hz_),
                                 kPatience);
    while (!stop.stop_requested()) {
      SceneState state = ReadSnapshot(stream.Next(), nq_);
      {
        const std::lock_guard lock(mutex_);
        states_.push_back(std::move(state));
        if (states_.size() > kSecondsKept * static_cast<std::size_t>(hz_)) states_.pop_front();
      }
      news_.notify_one();
      if (on_news_) on_news_();
    }
  } catch (const ControlError& error) {
    const std::lock_guard lock(mutex_);
    gone_ = error.what();
  }
  news_.notify_one();
  if (on_news_) on_news_();
}

std::deque<SceneState> LiveRobot::Take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, patience, [this] { return !states_.empty() || !gone_.empty(); });
  return std::exchange(states_, {});
}

std::string LiveRobot::gone() const {
  const std::lock_guard lock(mutex_);
  return states_.empty() ? gone_ : std::string();
}

}  // namespace understudy::viewer
