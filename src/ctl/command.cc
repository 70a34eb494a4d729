#include "ctl/command.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "client/client.h"
#include "client/listening_socket.h"
#include "ctl/ask.h"
#include "ctl/check.h"
#include "ctl/status_screen.h"
#include "ctl/text.h"

namespace understudy::ctl {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWaitPoll{50};
// A recording has to be completed, and a command of exec to end.
constexpr std::chrono::seconds kEndPatience{30};
// Timeout between two events with --follow.
constexpr std::chrono::hours kQuiet{24 * 365};
// s, a day: longer than any script waits, and far below the range of a duration.
constexpr double kLongestWait = 86'400;

// Returns "" if the robot is ready, else the reason.
std::string WhyNotReady(const ordered_json& status) {
  if (status.at("silenced").get<bool>()) return "it is silenced: another robot is on this network";
  return status.at("ready").get<bool>() ? "" : "it is starting";
}

// Parses a reply and returns use(reply). Throws ControlError if its JSON is not as expected.
template <class Use>
auto Read(const std::string& reply, Use use) {
  try {
    return use(ordered_json::parse(reply));
  } catch (const json::exception& error) {
    throw NotOurVersion(error);
  }
}

std::string JsonLine(const ordered_json& reply) { return reply.dump() + "\n"; }

std::string UrlOf(const ordered_json& panel) { return panel.at("url").get<std::string>() + "\n"; }

}  // namespace

CtlCommand::CtlCommand(CLI::App* app, std::ostream* out) : out_(out) {
  CLI::App* ctl =
      app->add_subcommand("ctl", "Read the state of a running robot, or send it a request");
  ctl->require_subcommand(1);
  ctl->footer(
      "Examples:\n"
      "  understudy ctl wait                     until the robot sends its state\n"
      "  understudy ctl status --watch           a live screen; --json: one line for a script\n"
      "  understudy ctl pause                    time stands still; `step 10`, `resume`\n"
      "  understudy ctl --name left crane lower 0.2\n"
      "If several robots run, it asks for one on a terminal; elsewhere name one with --name.\n"
      "Exits with 1 if no robot or more than one matches, or if the robot refuses the request.");
  client::AddRobotChoice(ctl, &robot_);
  AddReading(ctl);
  AddRequests(ctl);
}

void CtlCommand::AddReading(CLI::App* ctl) {
  CLI::App* status =
      AddAction(ctl, "status", "Show what the robot is doing", [this] { ShowStatus(); });
  status->add_flag("--watch", watch_, "Show it again and again, with rates, until Ctrl-C");
  status->add_option("--every", every_, "Seconds between two outputs, with --watch")
      ->capture_default_str()
      ->check(NumberWithin(0.1, kLongestWait));
  status->footer(
      "Examples:\n"
      "  understudy ctl status --watch           a live screen\n"
      "  understudy ctl status --json | jq .base.height");

  CLI::App* wait =
      AddAction(ctl, "wait", "Wait until the robot sends its state", [this] { AwaitReady(); });
  wait->add_option("--timeout", timeout_, "Seconds after which to give up")
      ->capture_default_str()
      ->check(NumberWithin(0, kLongestWait));
  wait->footer("Example: understudy run go2 & understudy ctl wait && ./my_program lo");

  AddAction(ctl, "list", "Show the robots that run", [this] {
    ShowRobots();
  })->footer("Example: understudy ctl list");

  CLI::App* snapshot = AddAction(ctl, "snapshot", "Print one instant of the robot as JSON",
                                 [this] { ShowSnapshots(); });
  snapshot->add_flag("--watch", watch_, "Print a line for each instant until Ctrl-C");
  snapshot->add_option("--hz", hz_, "Lines per second at most, with --watch, 1 to 240")
      ->capture_default_str();
  snapshot->add_option("--parts", parts_, "Parts to print, such as qpos,contacts,motors [all]")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            const bool words = std::all_of(text.begin(), text.end(), [](char c) {
              return (c >= 'a' && c <= 'z') || c == '_' || c == ',';
            });
            return words ? "" : "expected words separated by commas, got " + text;
          },
          ""));
  snapshot->footer(
      "Examples:\n"
      "  understudy ctl snapshot --parts com,feet\n"
      "  understudy ctl snapshot --parts imus --watch --hz 10 | jq .imus[0].gyroscope");
  AddDamage(ctl);
  AddAction(ctl, "faults", "Show what is wrong with the robot", [this] {
    Show("/snapshot?parts=faults", FaultsText);
  })->footer("Example: understudy ctl faults; `ctl fault --help` says how to cause one");
  AddAction(ctl, "scene", "Print the geometry of the robot and its surroundings as JSON", [this] {
    Show("/scene", JsonLine);
  })->footer("Example: understudy ctl scene | jq .bodies[].name");

  CLI::App* events =
      AddAction(ctl, "events", "Show the events of the robot", [this] { ShowEvents(); });
  events->add_flag("--follow", watch_, "Then show new events until Ctrl-C");
  events->footer("Example: understudy ctl events --follow");
  CLI::App* log = AddAction(ctl, "log", "Show the log of a robot that `run --detach` started",
                            [this] { ShowLog(); });
  log->add_flag("--follow", watch_, "Then show new lines until the robot ends");
  log->footer("Example: understudy ctl log --follow");
  AddAction(ctl, "timings", "Show how punctual the ticks are", [this] {
    Show("/timings", FieldsText);
  })->footer("Example: understudy ctl timings");
  AddAction(ctl, "metrics", "Print its metrics in the format of Prometheus", [this] {
    *out_ << Ask(client::ChosenSocket(robot_), "GET", "/metrics", "");
  })->footer("Example: understudy ctl metrics | grep winding");
  AddAction(ctl, "stop", "End the robot, as Ctrl-C in its terminal does", [this] {
    Stop();
  })->footer("Example: understudy ctl stop --name left");
  AddAction(ctl, "panel", "Print the address of the robot's panel for a browser", [this] {
    Show("/panel", UrlOf);
  })->footer("Example: xdg-open \"$(understudy ctl panel)\"");
}

void CtlCommand::AddDamage(CLI::App* ctl) {
  CLI::App* damage = AddAction(ctl, "damage", "Show what the run would have done to the robot",
                               [this] { ShowDamage(); });
  damage->add_flag("--all", all_, "All motors, and where the limits come from");
  damage->add_flag("--check", check_, "Exit with 10 if a figure is beyond its limit");
  damage->footer(
      "Of each figure what it has reached since the start of the run, its limit, and a mark:\n"
      "ok, near (from 80 % of the limit on) or BEYOND. Of the motors' figures the motor that is\n"
      "worst by its limit counts. Motors that are near a limit or beyond one have a row.\n"
      "Examples:\n"
      "  understudy ctl damage\n"
      "  understudy ctl damage --check           for scripts and CI: the exit code says it\n"
      "  understudy ctl damage --json | jq .damage.falls");
}

CLI::App* CtlCommand::AddAction(CLI::App* parent, const std::string& name, const std::string& help,
                                std::function<void()> action) {
  CLI::App* command = parent->add_subcommand(name, help);
  command->fallthrough();
  command->add_flag("--json", json_, "One line of JSON, SI units");
  command->callback([this, run = std::move(action)] { action_ = run; });
  return command;
}

void CtlCommand::ShowStatus() const {
  const std::filesystem::path socket = client::ChosenSocket(robot_);
  if (watch_) return WatchStatus(socket);
  const std::string status = Ask(socket, "GET", "/status", "");
  *out_ << (json_ ? status : Read(status, StatusText));
}

void CtlCommand::WatchStatus(const std::filesystem::path& socket) const {
  const bool terminal = out_ == &std::cout && ::isatty(STDOUT_FILENO) != 0;
  const auto period = milliseconds{std::llround(every_ * 1000)};
  StatusScreen screen;
  while (true) {
    const std::string status = Ask(socket, "GET", "/status", "");
    if (json_) {
      *out_ << status << std::flush;
    } else {
      const std::string text = Read(status, [&](const ordered_json& read) {
        return screen.Text(read, steady_clock::now().time_since_epoch());
      });
      *out_ << (terminal ? OverTheScreen(text) : text + "\n") << std::flush;
    }
    std::this_thread::sleep_for(period);
  }
}

void CtlCommand::ShowSnapshots() const {
  const std::string parts = parts_.empty() ? "" : "parts=" + parts_;
  if (!watch_) return Show("/snapshot?" + parts, JsonLine);
  client::ControlStream snapshots(client::ChosenSocket(robot_),
                                  "/snapshots?hz=" + std::to_string(hz_) + "&" + parts,
                                  kCallTimeout);
  while (true) *out_ << snapshots.Next() << '\n' << std::flush;
}

void CtlCommand::ShowDamage() {
  const std::string reply = Ask(client::ChosenSocket(robot_), "GET", "/snapshot?parts=damage", "");
  *out_ << Read(reply, [&](const ordered_json& snapshot) {
    if (check_ && BeyondCount(snapshot) > 0) code_ = ExitCode::kFailed;
    return json_ ? reply : DamageText(snapshot, all_);
  });
}

void CtlCommand::ShowEvents() const {
  if (!watch_) return Show("/events", EventsText);
  client::ControlStream events(client::ChosenSocket(robot_), "/events", kQuiet);
  while (true) {
    const std::string event = events.Next();
    *out_ << (json_ ? event + "\n" : Read(event, EventText)) << std::flush;
  }
}

void CtlCommand::ShowLog() const {
  const std::filesystem::path socket = client::ChosenSocket(robot_);
  const auto status = ordered_json::parse(Ask(socket, "GET", "/status", ""));
  const auto path = status.value("log", std::string());
  if (path.empty()) {
    throw ControlError(
        "its log is in the terminal where it was started; only `understudy run --detach` writes "
        "one to a file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ControlError(path + ": " + std::strerror(errno));
  bool runs = true;
  while (true) {
    std::array<char, 4096> piece{};
    while (file.read(piece.data(), piece.size()), file.gcount() > 0) {
      out_->write(piece.data(), file.gcount());
    }
    *out_ << std::flush;
    if (!watch_ || !runs) return;
    std::this_thread::sleep_for(kWaitPoll);
    runs = client::ProbeSocket(socket).pid != 0;  // then the last lines are read
    file.clear();
  }
}

void CtlCommand::AwaitReady() const {
  const auto patience = milliseconds{std::llround(timeout_ * 1000)};
  const auto until = steady_clock::now() + patience;
  client::RobotChoice robot = robot_;
  std::string why;
  do {
    const client::RobotPlace place = client::FindRobot(robot);
    why = place.why;
    if (place.socket) {
      robot = {.name = {}, .socket = *place.socket};  // look for it, or ask, only once
      try {
        const auto left =
            std::chrono::duration_cast<milliseconds>(until - steady_clock::now()) + kWaitPoll;
        why = WhyNotReady(ordered_json::parse(
            Ask(*place.socket, "GET", "/status", "", std::min(left, kCallTimeout))));
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

void CtlCommand::Stop() const {
  const std::filesystem::path socket = client::ChosenSocket(robot_);
  const client::SocketProbe probe = client::ProbeSocket(socket);
  if (probe.pid == 0) {
    throw ControlError("the robot's process is not visible from here: end it where it was started");
  }
  if (::kill(probe.pid, SIGTERM) != 0) {
    throw ControlError("process " + std::to_string(probe.pid) +
                       " cannot be ended: " + std::strerror(errno));
  }
  const auto until = steady_clock::now() + kEndPatience;
  while (client::ProbeSocket(socket).pid == probe.pid) {
    if (steady_clock::now() > until) {
      throw ControlError("process " + std::to_string(probe.pid) +
                         " was asked to end and still runs");
    }
    std::this_thread::sleep_for(kWaitPoll);
  }
}

void CtlCommand::ShowRobots() const {
  const std::vector<client::RunningRobot> robots = client::FindRobots();
  if (!json_) {
    *out_ << RobotsText(robots);
    return;
  }
  ordered_json list = ordered_json::array();
  for (const client::RunningRobot& robot : robots) {
    list.push_back({{"name", robot.name}, {"socket", robot.socket.string()}, {"pid", robot.pid}});
  }
  *out_ << list << '\n';
}

void CtlCommand::Show(const std::string& path, Teller tell) const {
  const std::string reply = Ask(client::ChosenSocket(robot_), "GET", path, "");
  *out_ << (json_ ? reply : Read(reply, tell));
}

}  // namespace understudy::ctl
