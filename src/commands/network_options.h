// The network of a robot and its program: options and entering it, of `exec` and `rehearse`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "config/config.h"
#include "exec/private_network.h"

namespace understudy::commands {

struct NetworkArguments {
  std::string network = "private";
  exec::CableEnd program{.interface = {}, .address = "192.168.123.99"};  // interface "": only lo
};

// Adds --network, --interface-name and --address. `arguments` must outlive parsing.
void AddNetworkOptions(CLI::App* app, NetworkArguments* arguments);

// Throws CLI::ParseError if they contradict each other. For the callback of the command.
void RequireConsistent(const NetworkArguments& arguments);

// Returns the options as words of a command line, without those that have their default.
std::vector<std::string> WordsOf(const NetworkArguments& arguments);

// Where robot and program are. Make it while the process has one thread and no socket that the
// robot is to use; fork the program with `program_rights()`; then let the robot `Settle()`. It has
// to outlive the robot.
class RunNetwork {
 public:
  // Enters the network. Sets network.interface of `config` to --interface-name if that is given;
  // throws ConfigError if it names another interface, BusError as exec/private_network.h.
  RunNetwork(const NetworkArguments& arguments, config::Config* config);

  // Whether nothing leads out of it.
  bool is_private() const { return private_; }

  // For ChildProcess; null: those of this process.
  const exec::Capabilities* program_rights() const { return cable_ ? &cable_->rights() : nullptr; }

  // Moves this process to where the robot is. Throws BusError.
  void Settle();

 private:
  bool private_;
  std::optional<exec::CabledNetwork> cable_;
};

}  // namespace understudy::commands
