#include "control/ctl_command.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "control/control_error.h"
#include "control/control_folder.h"
#include "control/ctl_text.h"
#include "control/order_json.h"
#include "robot/nearest_word.h"

namespace understudy {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using std::chrono::steady_clock;

// Longer than the server's patience with the tick, so that it is the server who says why.
constexpr std::chrono::milliseconds kCallTimeout{5'000};
constexpr std::chrono::milliseconds kWaitPoll{50};
constexpr std::chrono::seconds kWatchPeriod{1};
// A day: longer than any script waits, and well within what a duration holds.
constexpr double kLongestWait = 86'400;
constexpr double kShove = 0.1;  // s that a push lasts unless told otherwise; *assumed*

// "" when `text` is a finite number from `low` to `high`, else what was expected.
std::string CheckNumber(const std::string& text, double low, double high) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
  std::ostringstream expected;
  expected << "expected a number from " << low << " to " << high << ", got " << text;
  return expected.str();
}

CLI::Validator NumberWithin(double low, double high) {
  return {[=](std::string& text) { return CheckNumber(text, low, high); }, ""};
}

// The "error" of a reply that was not 200.
std::string ReasonOf(const ControlReply& reply) {
  const json body = json::parse(reply.body, nullptr, false);
  if (body.is_object() && body.contains("error") && body["error"].is_string()) {
    return body["error"];
  }
  return "the robot answered with HTTP status " + std::to_string(reply.status);
}

std::string Ask(const std::filesystem::path& socket, const std::string& method,
                const std::string& path, const std::string& body,
                std::chrono::milliseconds timeout = kCallTimeout) {
  ControlReply reply = Call(socket, method, path, body, timeout);
  if (reply.status != 200) throw ControlError(ReasonOf(reply));
  return std::move(reply.body);
}

ControlError NotOurVersion(const json::exception& error) {
  return ControlError(std::string{"the robot speaks another version of the control plane: "} +
                      error.what());
}

// "" when ready, else what is missing.
std::string WhyNotReady(const std::string& status) {
  const json read = json::parse(status);
  if (read.at("silenced").get<bool>()) return "it was silenced: another robot is on this network";
  return read.at("ready").get<bool>() ? "" : "it is starting";
}

std::vector<std::string> NamesOf(const std::vector<RunningRobot>& robots) {
  std::vector<std::string> names;
  for (const RunningRobot& robot : robots) names.push_back(robot.name);
  return names;
}

}  // namespace

CtlCommand::CtlCommand(CLI::App* app, std::ostream* out) : out_(out) {
  CLI::App* ctl = app->add_subcommand("ctl", "Ask a running robot, or give it an order");
  ctl->require_subcommand(1);
  ctl->footer(
      "Examples:\n"
      "  understudy ctl wait                     until the only robot sends its state\n"
      "  understudy ctl status --json            one line for a script\n"
      "  understudy ctl --name left crane lower 0.2\n"
      "Exits with 1 when there is no such robot or it refuses.");
  CLI::Option* name =
      ctl->add_option("--name", name_, "The robot's name; `understudy ctl list` shows them");
  ctl->add_option("--socket", socket_,
                  "The robot's control socket [else $UNDERSTUDY_CONTROL, else the only one]")
      ->excludes(name);

  CLI::App* status = AddAction(ctl, "status", "Show what the robot does", [this] { ShowStatus(); });
  status->add_flag("--json", json_, "One line of JSON, SI units");
  status->add_flag("--watch", watch_, "Again every second, until interrupted");

  CLI::App* wait =
      AddAction(ctl, "wait", "Wait until the robot sends its state", [this] { AwaitReady(); });
  wait->add_option("--timeout", timeout_, "Seconds after which to give up")
      ->capture_default_str()
      ->check(NumberWithin(0, kLongestWait));

  CLI::App* list = AddAction(ctl, "list", "Show the robots that run", [this] { ShowRobots(); });
  list->add_flag("--json", json_, "One line of JSON");

  AddCrane(ctl);
  AddPush(ctl);
  AddRemote(ctl);

  CLI::App* clamp = ctl->add_subcommand("clamp", "Hold the base where it is, or let it go");
  clamp->require_subcommand(1)->fallthrough();
  AddAction(clamp, "on", "Hold the base", [this] { GiveOrder("/clamp", {{"on", true}}); });
  AddAction(clamp, "off", "Let the base go", [this] { GiveOrder("/clamp", {{"on", false}}); });

  AddAction(ctl, "reset", "Back to the start pose",
            [this] { GiveOrder("/reset", json::object()); });
}

void CtlCommand::AddPush(CLI::App* ctl) {
  CLI::App* push =
      AddAction(ctl, "push", "Push a body with a force, world axes, for a time", [this] {
        const double seconds = seconds_ > 0 ? seconds_ : kShove;
        GiveOrder("/push", {{"body", body_}, {"force", force_}, {"seconds", seconds}});
      });
  push->add_option("BODY", body_, "A body of the model, such as base_link")->required();
  push->add_option("FORCE", force_, "FX FY FZ in N")
      ->required()
      ->expected(3)
      ->check(NumberWithin(-kMostForce, kMostForce));
  push->add_option("--for", seconds_, "Simulated seconds that it acts [0.1]")
      ->check(NumberWithin(0.0001, kMostSeconds));
  push->footer("Example: understudy ctl push base_link 100 0 0 --for 0.2");
}

void CtlCommand::AddRemote(CLI::App* ctl) {
  CLI::App* remote = ctl->add_subcommand("remote", "Use the remote controller");
  remote->require_subcommand(1)->fallthrough();
  remote->footer(
      "Keys: R1 L1 START SELECT R2 L2 F1 F2 A B X Y UP RIGHT DOWN LEFT, joined by +.\n"
      "Examples:\n"
      "  understudy ctl remote press L2+B          damping\n"
      "  understudy ctl remote stick ly=0.5 --for 2\n"
      "  understudy ctl remote off                 as if it were not there");
  const auto add_keys = [&](const char* name, const char* help) {
    CLI::App* action = AddAction(remote, name, help, [this, name] {
      nlohmann::json order{{name, keys_}};
      if (seconds_ > 0) order["seconds"] = seconds_;
      GiveOrder("/remote", order);
    });
    action->add_option("KEYS", keys_, "As in L2+B")->required();
    return action;
  };
  const auto add_time = [&](CLI::App* action, const char* help) {
    action->add_option("--for", seconds_, help)->check(NumberWithin(0, kMostSeconds));
  };
  add_time(add_keys("press", "Press keys together and let them go"),
           "Simulated seconds that they stay down [0.1]");
  add_keys("hold", "Hold keys until `release`");
  add_keys("release", "Let keys go");
  CLI::App* stick = AddAction(remote, "stick", "Move sticks", [this] {
    nlohmann::json sticks = json::object();
    for (const std::string& axis : axes_) {
      const std::size_t equals = axis.find('=');
      double value = 0;
      if (equals == std::string::npos ||
          !CLI::detail::lexical_cast(axis.substr(equals + 1), value)) {
        throw ControlError("expected AXIS=VALUE, as in ly=0.5, got " + axis);
      }
      sticks[axis.substr(0, equals)] = value;
    }
    GiveOrder("/remote", {{"sticks", sticks}, {"seconds", seconds_}});
  });
  stick->add_option("AXIS=VALUE", axes_, "lx, ly, rx or ry, from -1 to 1")->required();
  add_time(stick, "Simulated seconds after which they come back to the middle [never]");
  AddAction(remote, "on", "Switch it on", [this] { GiveOrder("/remote", {{"on", true}}); });
  AddAction(remote, "off", "Switch it off", [this] { GiveOrder("/remote", {{"on", false}}); });
}

void CtlCommand::AddCrane(CLI::App* ctl) {
  CLI::App* crane = ctl->add_subcommand("crane", "Work the crane");
  crane->require_subcommand(1)->fallthrough();
  const CLI::Validator length = NumberWithin(-kMostCraneOrder, kMostCraneOrder);
  AddAction(crane, "lower", "Pay out M metres",
            [this] {
              GiveOrder("/crane", {{"lower", metres_}});
            })
      ->add_option("M", metres_, "Metres")
      ->required()
      ->check(length);
  AddAction(crane, "raise", "Take in M metres",
            [this] {
              GiveOrder("/crane", {{"raise", metres_}});
            })
      ->add_option("M", metres_, "Metres")
      ->required()
      ->check(length);
  AddAction(crane, "attach", "Hang the robot where it is", [this] {
    GiveOrder("/crane", {{"attach", true}});
  });
  AddAction(crane, "release", "Let the robot off the hook", [this] {
    GiveOrder("/crane", {{"release", true}});
  });
}

CLI::App* CtlCommand::AddAction(CLI::App* parent, const std::string& name, const std::string& help,
                                std::function<void()> action) {
  CLI::App* command = parent->add_subcommand(name, help);
  command->fallthrough();
  command->callback([this, run = std::move(action)] { action_ = run; });
  return command;
}

CtlCommand::Target CtlCommand::FindTarget() const {
  if (!socket_.empty()) return {.socket = socket_, .why = {}};
  const char* from_environment = std::getenv("UNDERSTUDY_CONTROL");
  const bool named = !name_.empty();
  if (!named && from_environment != nullptr && *from_environment != '\0') {
    return {.socket = from_environment, .why = {}};
  }
  if (named) ControlSocket(name_);  // throws for what can be no name

  const std::vector<RunningRobot> robots = FindRobots();
  if (named) {
    const auto it = std::find_if(robots.begin(), robots.end(),
                                 [&](const RunningRobot& robot) { return robot.name == name_; });
    if (it != robots.end()) return {.socket = it->socket, .why = {}};
    const std::string nearest = NearestWord(name_, NamesOf(robots));
    const std::string hint = nearest.empty() ? "" : ": did you mean \"" + nearest + "\"?";
    return {.socket = {}, .why = "no robot named \"" + name_ + "\" runs" + hint};
  }
  if (robots.empty()) {
    return {.socket = {}, .why = "no robot runs; start one, as in `understudy run g1`"};
  }
  if (robots.size() == 1) return {.socket = robots.front().socket, .why = {}};
  std::string list;
  for (const std::string& name : NamesOf(robots)) list += (list.empty() ? "" : ", ") + name;
  throw ControlError("several robots run (" + list + "); choose one with --name NAME");
}

std::filesystem::path CtlCommand::TargetSocket() const {
  const Target target = FindTarget();
  if (!target.socket) throw ControlError(target.why);
  return *target.socket;
}

void CtlCommand::ShowStatus() const {
  const std::filesystem::path socket = TargetSocket();
  const bool terminal = out_ == &std::cout && ::isatty(STDOUT_FILENO) != 0;
  while (true) {
    const std::string status = Ask(socket, "GET", "/status", "");
    try {
      if (watch_ && terminal && !json_) *out_ << "\033[H\033[J";  // home, and clear from there on
      *out_ << (json_ ? status : StatusText(ordered_json::parse(status))) << std::flush;
    } catch (const json::exception& error) {
      throw NotOurVersion(error);
    }
    if (!watch_) return;
    std::this_thread::sleep_for(kWatchPeriod);
  }
}

void CtlCommand::AwaitReady() const {
  using std::chrono::milliseconds;
  const auto patience = milliseconds{std::llround(timeout_ * 1000)};
  const auto until = steady_clock::now() + patience;
  std::string why;
  do {
    const Target target = FindTarget();
    why = target.why;
    if (target.socket) {
      try {
        const auto left =
            std::chrono::duration_cast<milliseconds>(until - steady_clock::now()) + kWaitPoll;
        why = WhyNotReady(Ask(*target.socket, "GET", "/status", "", std::min(left, kCallTimeout)));
        if (why.empty()) return;
      } catch (const ControlError& error) {
        why = error.what();
      } catch (const json::exception& error) {
        throw NotOurVersion(error);
      }
    }
    std::this_thread::sleep_for(kWaitPoll);
  } while (steady_clock::now() < until);
  throw ControlError("no robot was ready after " + std::to_string(patience.count()) +
                     " ms: " + why);
}

void CtlCommand::ShowRobots() const {
  const std::vector<RunningRobot> robots = FindRobots();
  if (!json_) {
    *out_ << RobotsText(robots);
    return;
  }
  ordered_json list = ordered_json::array();
  for (const RunningRobot& robot : robots) {
    list.push_back({{"name", robot.name}, {"socket", robot.socket.string()}, {"pid", robot.pid}});
  }
  *out_ << list << '\n';
}

void CtlCommand::GiveOrder(const std::string& path, const json& body) const {
  Ask(TargetSocket(), "POST", path, body.dump());
}

}  // namespace understudy
