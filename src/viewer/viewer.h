// The window of `understudy view`: shows a running robot and handles keys and mouse.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "remote/remote_sender.h"
#include "viewer/live_robot.h"
#include "viewer/pointer.h"
#include "viewer/remote_keyboard.h"
#include "viewer/request_sender.h"
#include "viewer/screen_text.h"
#include "viewer/window.h"

namespace understudy::viewer {

class Viewer {
 public:
  Viewer(const std::filesystem::path& socket, const ViewArguments& arguments);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Runs until the window is closed or `should_stop` returns true.
  void Run(const std::function<bool()>& should_stop);

 private:
  double Now() const;  // s of wall time since the window opened
  void Take(const WindowEvent& event);
  void Press(const WindowEvent& key);
  bool PressShow(int key);
  void ChangeSpeed(double factor);
  void ChangeCamera(int by);
  void FollowOrNot();
  void TakeStates();
  void Pull();
  void Play(const WindowEvent& key);
  void HoldRemote();
  void Draw();
  void DrawGrip();
  void DrawText(const mjrRect& whole);

  std::filesystem::path socket_;
  ViewArguments arguments_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Window window_;
  Stage stage_;
  CameraOperator camera_;
  mjrContext context_;
  Pointer pointer_;
  ShowChoice show_;
  RealTimeFactor real_time_;
  RequestSender requests_;
  std::string notice_;       // of a refusal
  double notice_until_ = 0;  // s
  double drawing_ = 0;       // s spent drawing in total
  double drawn_at_ = 0;      // s
  double pulled_at_ = -1;    // s
  bool pulling_ = false;
  RemoteKeyboard remote_;
  remote::RemoteSender remote_sender_;
  bool playing_remote_ = false;
  bool help_ = false;
  bool close_ = false;
  bool dirty_ = true;
  LiveRobot robot_;  // last: its thread wakes the window
};

}  // namespace understudy::viewer
