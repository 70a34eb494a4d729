// The exit codes of `understudy`, documented in docs/reference/exit_codes.md and in --help.
#pragma once

namespace understudy {

enum class ExitCode {
  kOk = 0,
  kInternal = 1,   // a bug, a refused request, output that could not be written
  kUsage = 2,      // the command line
  kConfig = 3,     // a configuration file or --set
  kModel = 4,      // a model or scene
  kBus = 5,        // interface, domain, namespace
  kNeighbour = 6,  // another robot is on this network
  kDiverged = 7,   // the physics diverged and physics.on_divergence is stop
  kSocket = 8,     // the robot's name or control socket is in use or cannot be used
  kRecord = 9,     // a recording cannot be written or read
  kFailed = 10,    // rehearse, judge: an expectation failed; ctl damage --check: one is beyond
  kOpen = 11,      // rehearse, judge: none failed, and one could not be judged
  kUnfit = 12,     // doctor: something is wrong
};

}  // namespace understudy
