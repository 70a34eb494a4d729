// Errors that end the setup of a run. The loop never throws.
#ifndef UNDERSTUDY_ROBOT_ERRORS_H_
#define UNDERSTUDY_ROBOT_ERRORS_H_

#include <stdexcept>
#include <string>

namespace understudy {

// Base of every error that a user can cause. what() is one line that names file, line, key or
// value, what was expected, what was found, and the nearest valid word where there is one.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A configuration file or a --set option.
class ConfigError : public SetupError {
 public:
  using SetupError::SetupError;
};

// A robot model or scene, or a robot description that does not fit its model.
class ModelError : public SetupError {
 public:
  using SetupError::SetupError;
};

// The network: interface, domain, topics.
class BusError : public SetupError {
 public:
  using SetupError::SetupError;
};

// Somebody else's robot is already on this network.
class NeighbourError : public SetupError {
 public:
  using SetupError::SetupError;
};

// A recording: not to be written, or not to be read.
class RecordError : public SetupError {
 public:
  using SetupError::SetupError;
};

}  // namespace understudy

#endif  // UNDERSTUDY_ROBOT_ERRORS_H_
