// What `understudy` exits with. Documented in the README and in --help.
#pragma once

namespace understudy {

enum class ExitCode {
  kOk = 0,
  kInternal = 1,   // a bug, or a robot that refused a `ctl` order
  kUsage = 2,      // the command line
  kConfig = 3,     // a configuration file or --set
  kModel = 4,      // a model or scene
  kBus = 5,        // interface, domain, namespace
  kNeighbour = 6,  // another robot is on this network
  kDiverged = 7,   // the physics diverged and physics.on_divergence is stop
  kSocket = 8,     // the robot's name or its control socket: in use, or not to be had
  kRecord = 9,     // a recording: not to be written, or not to be read
};

}  // namespace understudy
