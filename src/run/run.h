// Runs the robots of a world: networks, world, the loop around the tick with its attachments, other
// threads.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/exit_code.h"
#include "config/config.h"
#include "run/attachments.h"
#include "run/recording.h"
#include "script/script.h"
#include "server/panel_socket.h"
#include "time/program_clock.h"

namespace understudy::run {

// Where observers reach a robot.
struct Access {
  std::filesystem::path socket;                // for `ctl`; in a folder made by MakeControlFolder
  const server::PanelSocket* panel = nullptr;  // null: no panel
};

struct RunOptions {
  std::vector<Access> access;  // by number of the robot
  script::Script script;       // may be empty
  RecordingOptions recording;  // of several robots as RecordingOf has it
  // Of the recordings, by number of the robot; may be empty.
  std::vector<record::Audience*> audiences;
  // By number of the robot, whether its recording has the nearest obstacle; may be empty.
  std::vector<bool> obstacles;
  std::filesystem::path log;               // the file of the log, "" if it is none's
  bool private_network = false;            // of exec: nothing leads out of it
  time::ProgramClock* programs = nullptr;  // null: programs are on real time
  bool status_line = false;                // redraw a line on the terminal
  // Called once in the loop's thread after the first LowState, with the URL of the first robot's
  // panel, "" without one. May be empty.
  std::function<void(const std::string& panel)> on_ready;
  // Called after each cycle in the loop's thread; true ends the run. It may add events.
  StopRule::ShouldStop should_stop;
};

// Runs the robots until should_stop, the configured duration or a divergence, and returns the exit
// code. Throws SetupError only before anything is published. `config` is validated.
ExitCode RunWorld(const config::Config& config, const RunOptions& options);

}  // namespace understudy::run
