// A fake robot for `understudy ctl`: a server without a tick.
#pragma once

#include <filesystem>
#include <utility>

#include "server/server.h"
#include "tests/support/control.h"

namespace understudy::ctl {

// Records requests and gives the set answers.
class FakeRobot {
 public:
  explicit FakeRobot(const std::filesystem::path& socket, emulator::Answer answer = {},
                     emulator::Snapshot snapshot = {})
      : snapshots_(std::move(snapshot)),
        ticking_(&inbox_,
                 [this, answer = std::move(answer)](const emulator::Request& request) {
                   last_ = request;
                   return answer;
                 }),
        showing_(&snapshots_),
        server_(socket, {.identity = {.robot = "g1"},
                         .board = &board_,
                         .inbox = &inbox_,
                         .snapshots = &snapshots_,
                         .events = server::EventHistory(&events_)}) {}

  emulator::StatusBoard* board() { return &board_; }
  // Snapshots so far.
  std::int64_t shown() const { return showing_.shown(); }
  // Only after a request was answered.
  const emulator::Request& last() const { return last_; }

 private:
  // Something has happened before anybody asks.
  struct Events : emulator::EventRing {
    Events() { Add(emulator::EventKind::kClamp, 0, {1}); }
  };

  Events events_;
  emulator::Request last_;
  emulator::StatusBoard board_;
  emulator::Inbox inbox_;
  emulator::SnapshotMailbox snapshots_;
  test::Ticking ticking_;
  test::Showing showing_;
  server::ControlServer server_;
};

}  // namespace understudy::ctl
