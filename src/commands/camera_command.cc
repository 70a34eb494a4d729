#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/errors.h"
#include "base/files.h"
#include "base/nearest_word.h"
#include "base/signals.h"
#include "client/client.h"
#include "client/robot_choice.h"
#include "commands/commands.h"
#include "ctl/ask.h"
#include "ctl/check.h"
#include "ctl/text.h"
#include "simclock/standing_time.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPictureWait{40};    // more than ServerLimits::picture
constexpr std::chrono::milliseconds kStopLook{50};  // between looks at the stop flag
constexpr unsigned kNoneThisTime = 503;
constexpr double kMostHz = 60;          // *assumed*: more than cameras have
constexpr double kLongestStream = 1e9;  // s

struct CameraArguments {
  client::RobotChoice robot;
  std::string name;
  std::string out;
  double hz = 10;
  double seconds = 0;  // 0: until Ctrl-C
  bool depth = false;
  bool overwrite = false;
};

// The picture comes in real time, also to a program on a simulated clock.
client::ControlReply Look(const fs::path& socket, const std::string& path) {
  const simclock::StandingTime stands;
  return client::Call(socket, "GET", path, "", kPictureWait);
}

nlohmann::json CamerasOf(const fs::path& socket) {
  try {
    return nlohmann::json::parse(ctl::Ask(socket, "GET", "/cameras", "")).at("cameras");
  } catch (const nlohmann::json::exception& error) {
    throw ctl::NotOurVersion(error);
  }
}

// Returns the path of its pictures or depths. Throws ControlError with the nearest name if there is
// none.
std::string PathOf(const fs::path& socket, const std::string& name, bool depth) {
  std::vector<std::string> names;
  for (const auto& camera : CamerasOf(socket)) names.push_back(camera.at("name"));
  if (std::ranges::find(names, name) != names.end()) {
    return "/cameras/" + name + (depth ? "/depth" : "");
  }
  throw ControlError(names.empty() ? "this robot has no camera"
                                   : "no camera '" + name + "'" + DidYouMean(name, names));
}

int List(const fs::path& socket) {
  std::vector<ctl::Cells> rows = {{"CAMERA", "PIXELS", "DEPTH", "SERVICE", "VIDEO"}};
  for (const auto& camera : CamerasOf(socket)) {
    const std::string service = camera.at("service");
    const int port = camera.at("video").at("port");
    rows.push_back({camera.at("name"),
                    std::to_string(camera.at("width").get<int>()) + "x" +
                        std::to_string(camera.at("height").get<int>()),
                    camera.at("depth") ? "yes" : "none", service.empty() ? "none" : service,
                    port == 0 ? "none" : "230.1.1.1:" + std::to_string(port)});
  }
  std::cout << (rows.size() == 1 ? "this robot has no camera\n" : ctl::Aligned(rows));
  return 0;
}

// Pictures one behind the other, until the reader has gone.
int Stream(const CameraArguments& arguments, const fs::path& socket, const std::string& path) {
  if (::isatty(STDOUT_FILENO) == 1) {
    throw SetupError("--out -: standard output is a terminal; lead it into a file or a program");
  }
  CatchStopSignals();
  std::signal(SIGPIPE, SIG_DFL);  // a reader that goes ends it, as it ends others
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / arguments.hz));
  const Clock::time_point begin = Clock::now();
  const auto over = [&] {
    return StopSignal() != 0 ||
           (arguments.seconds > 0 &&
            Clock::now() - begin >= std::chrono::duration<double>(arguments.seconds));
  };
  for (Clock::time_point next = begin; !over(); next = std::max(next + period, Clock::now())) {
    while (Clock::now() < next && !over()) {
      std::this_thread::sleep_until(std::min(next, Clock::now() + kStopLook));
    }
    if (over()) break;
    client::ControlReply reply = Look(socket, path);
    if (reply.status == kNoneThisTime) continue;
    const std::string picture = ctl::BodyOf(std::move(reply));
    if (std::fwrite(picture.data(), 1, picture.size(), stdout) != picture.size()) break;
    if (std::fflush(stdout) != 0) break;
  }
  return 0;
}

int Run(const CameraArguments& arguments) {
  const fs::path socket = client::ChosenSocket(arguments.robot);
  if (arguments.name.empty()) return List(socket);
  if (arguments.out != "-") CheckWritable(arguments.out, arguments.overwrite);
  const std::string path = PathOf(socket, arguments.name, arguments.depth);
  if (arguments.out == "-") return Stream(arguments, socket, path);
  WriteFile(arguments.out, ctl::BodyOf(Look(socket, path)));
  return 0;
}

}  // namespace

void AddCameraCommand(CLI::App* app, Chosen* chosen) {
  auto arguments = std::make_shared<CameraArguments>();
  CLI::App* const command = app->add_subcommand("camera", "Show what a robot's camera sees");
  CLI::Option* const name =
      command->add_option("camera", arguments->name, "Its name [lists the robot's cameras]")
          ->type_name("CAMERA");
  client::AddRobotChoice(command, &arguments->robot);
  CLI::Option* const out =
      command
          ->add_option("--out", arguments->out,
                       "File for one picture; - writes pictures to standard output, one behind the "
                       "other, until Ctrl-C")
          ->type_name("FILE")
          ->needs(name);
  name->needs(out);
  command
      ->add_flag(
          "--depth", arguments->depth,
          "The depth that it measures, in place of a JPEG: a PNG of 16 bits, in mm along the "
          "axis of the picture, 0 where there is none")
      ->needs(out);
  command->add_option("--hz", arguments->hz, "With --out -: at most so many pictures a second [10]")
      ->check(ctl::NumberWithin(0.01, kMostHz))
      ->type_name("HZ")
      ->needs(out);
  command->add_option("--seconds", arguments->seconds, "With --out -: ends after that time [never]")
      ->check(ctl::NumberWithin(0, kLongestStream))
      ->type_name("S")
      ->needs(out);
  command->add_flag("--overwrite", arguments->overwrite, "Replace the file that is there")
      ->needs(out);
  command->footer(
      "Pictures are those of the robot's own services, by the lens and with the faults of its\n"
      "camera. More: docs/seeing.md.\n"
      "Examples:\n"
      "  understudy camera\n"
      "  understudy camera front --out front.jpg\n"
      "  understudy camera front --out - --seconds 2 > front.mjpeg");
  command->final_callback(
      [chosen, arguments] { *chosen = [arguments] { return Run(*arguments); }; });
}

}  // namespace understudy::commands
