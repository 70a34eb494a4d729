#include "commands/network_options.h"

#include "base/errors.h"

namespace understudy::commands {
namespace {

void RequireNoOtherInterface(const std::string& chosen, const std::string& name) {
  if (chosen == config::NetworkConfig{}.interface || chosen == name) return;
  throw ConfigError("network.interface: '" + chosen + "', and --interface-name makes '" + name +
                    "', the only one beside lo; leave one of them out");
}

}  // namespace

void AddNetworkOptions(CLI::App* app, NetworkArguments* arguments) {
  app->add_option("--network", arguments->network,
                  "private: a new network namespace; host: the machine's network")
      ->check(CLI::IsMember({"private", "host"}));
  CLI::Option* const name =
      app->add_option("--interface-name", arguments->program.interface,
                      "Connect robot and program by a cable instead of lo: the program's end has "
                      "this name, such as eth0, and the robot's end the address 192.168.123.161")
          ->type_name("NAME")
          ->check(CLI::Validator(exec::WhyNoInterface, ""));
  app->add_option("--address", arguments->program.address,
                  "Address of the program's end of that cable [192.168.123.99/24]")
      ->type_name("ADDRESS")
      ->check(CLI::Validator(exec::WhyNoCableAddress, ""))
      ->needs(name);
}

void RequireConsistent(const NetworkArguments& arguments) {
  if (arguments.network == "private" || arguments.program.interface.empty()) return;
  throw CLI::ValidationError(
      "--interface-name",
      "makes an interface in a private network; with --network host choose an "
      "existing one by network.interface");
}

std::vector<std::string> WordsOf(const NetworkArguments& arguments) {
  const NetworkArguments usual;
  std::vector<std::string> words;
  const auto add = [&words](const char* option, const std::string& value,
                            const std::string& unless) {
    if (value != unless) words.insert(words.end(), {option, value});
  };
  add("--network", arguments.network, usual.network);
  add("--interface-name", arguments.program.interface, usual.program.interface);
  add("--address", arguments.program.address, usual.program.address);
  return words;
}

RunNetwork::RunNetwork(const NetworkArguments& arguments, config::Config* config)
    : private_(arguments.network == "private") {
  if (!private_) return;
  const std::string& name = arguments.program.interface;
  if (name.empty()) {
    exec::EnterPrivateNetwork();
    return;
  }
  for (config::RobotConfig& robot : config->robots) {
    RequireNoOtherInterface(robot.network.interface, name);
    robot.network.interface = name;
  }
  cable_.emplace(arguments.program);
}

void RunNetwork::Settle() {
  if (cable_) cable_->MoveToRobot();
}

}  // namespace understudy::commands
