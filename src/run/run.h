// Runs a robot: network, world, the loop around the tick, and the other threads.
#pragma once

#include <filesystem>
#include <functional>

#include "base/exit_code.h"
#include "config/config.h"
#include "emulator/events.h"
#include "run/recording.h"
#include "script/script.h"
#include "server/panel_socket.h"

namespace understudy::run {

struct RunOptions {
  std::filesystem::path control_socket;  // for `ctl`; in a folder made by MakeControlFolder
  script::Script script;                 // may be empty
  RecordingOptions recording;
  std::filesystem::path log;                   // the file of the log, "" if it is none's
  const server::PanelSocket* panel = nullptr;  // null: no panel
  bool private_network = false;                // of exec: nothing leads out of it
  bool status_line = false;                    // redraw a line on the terminal
  // Called once in the loop's thread after the first LowState, with the panel's URL, "" without
  // one. May be empty.
  std::function<void(const std::string& panel)> on_ready;
  // Called every 10 steps in the loop's thread; true ends the run. It may add events.
  std::function<bool(std::int64_t step, emulator::EventRing* events)> should_stop;
};

// Runs the robot until should_stop, the configured duration or a divergence, and returns the exit
// code. Throws SetupError only before anything is published. `config` is validated.
ExitCode RunRobot(const config::Config& config, const RunOptions& options);

}  // namespace understudy::run
