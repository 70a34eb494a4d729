// A whole run: the network, the robot, the loop around its tick, and everything beside it.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/exit_code.h"
#include "config/config.h"
#include "emulator/request.h"
#include "run/recording.h"
#include "server/panel_socket.h"

namespace understudy::run {

struct RunOptions {
  std::filesystem::path control_socket;       // where `ctl` finds the robot; see MakeControlFolder
  std::vector<emulator::ScriptEvent> script;  // what happens when; may be empty
  RecordingOptions recording;
  const server::PanelSocket* panel = nullptr;  // where a browser finds it; null: nowhere
  bool status_line = false;                    // redraw a line on the terminal
  // Called once in the loop's thread when the first LowState is out. May be empty.
  std::function<void()> on_ready;
  // Asked every 10 steps; true ends the run.
  std::function<bool()> should_stop;
};

// Plays the robot until should_stop, the configured duration or a divergence.
// Throws SetupError before the first word is said; afterwards it returns. `config` has been
// validated.
ExitCode RunRobot(const config::Config& config, const RunOptions& options);

}  // namespace understudy::run
