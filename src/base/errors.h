// Errors that end the setup of a run, each with the code that the program exits with. The loop
// never throws.
#pragma once

#include <stdexcept>
#include <string>

#include "base/exit_code.h"

namespace understudy {

// Base of every error that a user can cause. what() is one line that names file, line, key or
// value, what was expected, what was found, and the nearest valid word where there is one.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  // What the process should end with.
  virtual int exit_code() const { return static_cast<int>(ExitCode::kInternal); }
};

template <ExitCode kCode, class Base = SetupError>
class SetupErrorWithCode : public Base {
 public:
  using Base::Base;
  int exit_code() const override { return static_cast<int>(kCode); }
};

// A configuration file or a --set option.
class ConfigError : public SetupErrorWithCode<ExitCode::kConfig> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// A robot model or scene, or a robot description that does not fit its model.
class ModelError : public SetupErrorWithCode<ExitCode::kModel> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// The network: interface, domain, topics.
class BusError : public SetupErrorWithCode<ExitCode::kBus> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// Somebody else's robot is already on this network.
class NeighbourError : public SetupErrorWithCode<ExitCode::kNeighbour> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// A recording: not to be written, or not to be read.
class RecordError : public SetupErrorWithCode<ExitCode::kRecord> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// No running robot is there to be asked, or it refused.
class ControlError : public SetupError {
 public:
  using SetupError::SetupError;
};

// A robot's name is none or is in use, or the folder or file of a control socket cannot be used.
class SocketError : public SetupErrorWithCode<ExitCode::kSocket, ControlError> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

}  // namespace understudy
