// The program of `understudy remote`.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/catch_errors.h"
#include "base/errors.h"
#include "base/exit_code.h"
#include "base/signals.h"
#include "client/client.h"
#include "remote/arguments.h"
#include "remote/gamepads.h"
#include "remote/keyboard.h"
#include "remote/picture.h"
#include "remote/raw_terminal.h"
#include "remote/remote_sender.h"

namespace understudy::remote {
namespace {

using nlohmann::json;

constexpr int kLoopMs = 10;
// Longer than the robot waits for its tick, so that the robot can report the reason.
constexpr std::chrono::milliseconds kCallTimeout{5'000};
constexpr double kStatusEvery = 1;     // s
constexpr double kEscapePause = 0.05;  // s after which an escape is the key; *assumed*
constexpr std::size_t kMostNotes = 4;

double Now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// The connection to the robot.
class Robot {
 public:
  explicit Robot(const std::filesystem::path& socket)
      : connection_(socket, kCallTimeout), name_(socket.stem()) {
    Update();
  }

  const std::string& name() const { return name_; }
  // Simulated seconds per second, as far as it is known.
  double speed() const { return speed_; }

  // Reads the status, which also keeps the connection alive and shows that the robot is there.
  void Update() {
    const json status = json::parse(Ask("GET", "/status", ""), nullptr, false);
    const double wanted = NumberAt(status, "/speed");
    const double reached = NumberAt(status, "/pace/real_time_factor");
    speed_ = std::max({wanted, reached, kSlowest});
  }

  void Set(const json& values) { Ask("POST", "/remote/set", values.dump()); }

 private:
  static constexpr double kSlowest = 0.01;

  static double NumberAt(const json& status, const char* where) {
    const json::json_pointer pointer(where);
    if (!status.is_object() || !status.contains(pointer)) return 0;
    const json& value = status.at(pointer);
    return value.is_number() ? value.get<double>() : 0;
  }

  std::string Ask(const char* method, const char* path, const std::string& body) {
    client::ControlReply reply = connection_.Ask(method, path, body, kCallTimeout);
    if (reply.status != 200) throw ControlError(name_ + ": " + reply.body);
    return std::move(reply.body);
  }

  client::ControlConnection connection_;
  std::string name_;
  double speed_ = 1;
};

// Combines both: all keys, and for each axis the larger deflection.
robot::RemoteReading Both(const robot::RemoteReading& one, const robot::RemoteReading& other) {
  const auto further = [](double a, double b) { return std::abs(a) >= std::abs(b) ? a : b; };
  return {.there = true,
          .keys = static_cast<std::uint16_t>(one.keys | other.keys),
          .lx = further(one.lx, other.lx),
          .ly = further(one.ly, other.ly),
          .rx = further(one.rx, other.rx),
          .ry = further(one.ry, other.ry)};
}

// The terminal with its keyboard and the picture.
class TerminalRemote {
 public:
  explicit TerminalRemote(std::string title) : title_(std::move(title)) {}

  // Waits at most kLoopMs. Returns false if the terminal has gone.
  bool Poll() {
    std::string typed;
    const bool there = terminal_.Read(kLoopMs, &typed);
    const double now = Now();
    if (!typed.empty()) {
      heard_at_ = now;
      Take(decoder_.Feed(typed), now);
    } else if (decoder_.waits() && now - heard_at_ >= kEscapePause) {
      Take(decoder_.Pause(), now);
    }
    return there;
  }

  const Keyboard& keyboard() const { return keyboard_; }

  void AddNote(const std::string& note) {
    notes_.push_back(note);
    if (notes_.size() > kMostNotes) notes_.erase(notes_.begin());
  }

  // Redraws the picture if it differs from the screen.
  void Show(const robot::RemoteReading& reading) {
    RemotePicture picture{.reading = reading, .title = title_, .notes = {}};
    picture.notes = {keyboard_.keeps_next() ? "Space: the next key is kept down"
                                            : "Space keeps a key, Esc lets go, Ctrl-C ends"};
    picture.notes.insert(picture.notes.end(), notes_.begin(), notes_.end());
    std::string screen = Draw(picture, terminal_.columns(), terminal_.rows());
    if (screen == shown_) return;
    terminal_.Write(screen);
    shown_ = std::move(screen);
  }

 private:
  void Take(const std::vector<TerminalKey>& keys, double now) {
    for (const TerminalKey& key : keys) keyboard_.Take(key, now);
  }

  RawTerminal terminal_;
  TerminalDecoder decoder_;
  Keyboard keyboard_;
  std::string title_;
  std::vector<std::string> notes_;
  std::string shown_;
  double heard_at_ = 0;
};

// Sends keyboard and gamepad to the robot until Ctrl-C. Throws SetupError if there is no such robot
// or it has gone. Without terminal and gamepad it waits for a gamepad.
void PlayRemote(const RemoteArguments& arguments) {
  Robot robot(client::ChosenSocket(arguments.robot));
  CatchStopSignals();
  std::optional<TerminalRemote> terminal;
  if (!arguments.no_keyboard && ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1) {
    terminal.emplace("remote controller of " + robot.name());
  }
  if (!terminal && !arguments.no_keyboard) {
    std::fprintf(stderr, "understudy remote: no keyboard: this is no terminal; gamepads only\n");
  }
  Gamepads gamepads({.which = arguments.gamepad, .mapping_file = arguments.mapping});
  RemoteSender sender([&](const json& values) { robot.Set(values); }, FirstPress());

  // Loop: read the devices, update the speed, send, draw.
  robot::RemoteReading gamepad;
  double asked_at = Now();
  while (StopSignal() == 0) {
    if (terminal) {
      if (!terminal->Poll()) break;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLoopMs));
    }
    const std::optional<GamepadState> state = gamepads.Poll();
    gamepad =
        state ? ReadGamepad(*state, arguments.dead_zone, gamepad.keys) : robot::RemoteReading{};
    for (const std::string& line : gamepads.TakeNews()) {
      if (terminal) {
        terminal->AddNote(line);
      } else {
        std::fprintf(stderr, "understudy remote: %s\n", line.c_str());
      }
    }

    const double now = Now();
    if (now - asked_at >= kStatusEvery) {
      robot.Update();
      asked_at = now;
    }
    sender.set_speed(robot.speed());
    const robot::RemoteReading held =
        terminal ? Both(terminal->keyboard().Read(now), gamepad) : gamepad;
    // Without a terminal and a gamepad there is no remote.
    if (terminal || state) {
      sender.Hold(held, now);
    } else {
      sender.LetGo(now);
    }
    if (terminal) terminal->Show(held);
  }
  sender.LetGo(Now());
}

int Main(int argc, char** argv) {
  CLI::App app("", "understudy");
  app.require_subcommand(1);
  RemoteArguments arguments;
  AddRemoteCommand(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  if (arguments.list_gamepads) {
    const Gamepads gamepads({.which = {}, .mapping_file = arguments.mapping});
    std::fputs(gamepads.List().c_str(), stdout);
    return 0;
  }
  PlayRemote(arguments);
  return 0;
}

}  // namespace
}  // namespace understudy::remote

int main(int argc, char** argv) {
  understudy::OpenClosedStreams();
  return understudy::CatchErrors([&] { return understudy::remote::Main(argc, argv); });
}
