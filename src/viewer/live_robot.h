// Reads model and states of a running robot over its control socket.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "viewer/scene_state.h"
#include "viewer/screen_text.h"
#include "viewer/stage.h"

namespace understudy::viewer {

// Returns the robot's model with its visual-only elements. Throws ControlError if the robot does
// not answer, ModelError if the model is of another MuJoCo version.
mjcf::ModelHandle FetchModel(const std::filesystem::path& socket);

// Returns its name in its world. Throws ControlError.
std::string FetchName(const std::filesystem::path& socket);

// Returns its present state. Throws ControlError.
SceneState FetchState(const std::filesystem::path& socket, std::size_t nq);

// Its events, asked for now and then.
class LiveEvents {
 public:
  explicit LiveEvents(std::filesystem::path socket);

  // Returns the events that pictures show (record::IsForPictures) and that were not returned
  // before, oldest first; none while the robot does not answer. At most one question in kPatience
  // of wall time.
  std::vector<FilmEvent> News();

  static constexpr std::chrono::milliseconds kPatience{100};

 private:
  std::filesystem::path socket_;
  std::chrono::steady_clock::time_point asked_{};
  std::int64_t next_ = 0;  // number of the next event
};

// Receives its states in a separate thread.
class LiveRobot {
 public:
  // `hz` is the highest number of states per second of wall time, `nq` that of the model. `on_news`
  // is called in the thread when there is something to take. Throws ControlError if nothing
  // listens.
  LiveRobot(const std::filesystem::path& socket, int hz, std::size_t nq,
            std::function<void()> on_news = {});

  // Returns the states since the last call, oldest first. Waits up to `patience` for the first.
  // States that are not taken for a minute are dropped.
  std::deque<SceneState> Take(std::chrono::milliseconds patience);

  // Returns why no more states will come; "" while they may.
  std::string gone() const;

 private:
  void Receive(const std::stop_token& stop, const std::filesystem::path& socket);

  int hz_;
  std::size_t nq_;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::deque<SceneState> states_;
  std::string gone_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::viewer
