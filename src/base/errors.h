// Errors that end the setup of a run, each with its exit code. The loop never throws.
#pragma once

#include <stdexcept>
#include <string>

#include "base/exit_code.h"

namespace understudy {

// Base of all errors that a user can cause. what() is one line: file, line, key or value, what was
// expected, what was found, and the nearest valid word if there is one.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  // The exit code of the process.
  virtual int exit_code() const { return static_cast<int>(ExitCode::kInternal); }
};

template <ExitCode kCode, class Base = SetupError>
class SetupErrorWithCode : public Base {
 public:
  using Base::Base;
  int exit_code() const override { return static_cast<int>(kCode); }
};

// An invalid configuration file or --set option.
class ConfigError : public SetupErrorWithCode<ExitCode::kConfig> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// An invalid robot model or scene, or a robot description that does not fit its model.
class ModelError : public SetupErrorWithCode<ExitCode::kModel> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// A fault of the network: interface, domain, topics.
class BusError : public SetupErrorWithCode<ExitCode::kBus> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// Another robot is already on this network.
class NeighbourError : public SetupErrorWithCode<ExitCode::kNeighbour> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// A recording that cannot be written or read.
class RecordError : public SetupErrorWithCode<ExitCode::kRecord> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

// No running robot was found, or it refused.
class ControlError : public SetupError {
 public:
  using SetupError::SetupError;
};

// A robot's name is invalid or in use, or the folder or file of a control socket cannot be used.
class SocketError : public SetupErrorWithCode<ExitCode::kSocket, ControlError> {
 public:
  using SetupErrorWithCode::SetupErrorWithCode;
};

}  // namespace understudy
