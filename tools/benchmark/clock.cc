#include "clock.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include <netinet/in.h>
#include <sys/socket.h>

#include "base/printed.h"
#include "base/temporary_folder.h"
#include "base/unique_fd.h"
#include "process.h"

namespace understudy::bench {
namespace {

using Words = std::vector<std::string>;
using std::chrono::steady_clock;

constexpr int kRepeats = 0, kDiffers = 10;  // exit codes of rehearse --twice
constexpr double kRehearsed = 10;           // simulated s of a rehearsal
constexpr double kWantedRehearsals = 8;     // times real time, of a core
constexpr double kWantedAlone = 0.9;        // of --speed max

Words Joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Empty without a file.
std::string FileText(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A thread on each core, until this goes. The network is that of the thread that makes it.
class Disturbance {
 public:
  explicit Disturbance(void (*work)(const std::stop_token&)) {
    for (int i = 0; i < Cores(); ++i) threads_.emplace_back(work);
  }

 private:
  std::vector<std::jthread> threads_;
};

void Spin(const std::stop_token& stop) {
  for (std::atomic<std::uint64_t> turns = 0; !stop.stop_requested();) ++turns;
}

void Flood(const std::stop_token& stop) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to.sin_port = htons(9);  // discard
  const std::string bytes(1000, 'x');
  while (!stop.stop_requested()) {
    ::sendto(socket.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&to),
             sizeof(to));
  }
}

class Meter {
 public:
  Meter(std::string understudy, const ClockedProgram& program)
      : understudy_(std::move(understudy)), program_(program) {}

  bool released() const { return program_.released || program_.command.empty(); }
  // The command, or the C client for so many seconds.
  Words Command(double seconds) const {
    return program_.command.empty() ? Words{HOLDS_POSE, Printed("%g", seconds)} : program_.command;
  }

  // Simulated s per s of `understudy WORDS`, which logs how long it was simulated.
  double Speed(const Words& words) const {
    const std::string log = folder_.path() / "log";
    const auto begun = steady_clock::now();
    const int code =
        RunToEnd(Joined({"/bin/sh", "-c", "exec \"$@\" 2> \"$0\"", log, understudy_}, words));
    const double wall = std::chrono::duration<double>(steady_clock::now() - begun).count();
    const std::string text = FileText(log);
    const std::string mark = " has left the network after ";
    const std::size_t at = text.find(mark);
    if (code != 0 || at == std::string::npos) {
      throw std::runtime_error("a run on the clock failed: exit code " + std::to_string(code) +
                               "\n" + text);
    }
    return std::stod(text.substr(at + mark.size())) / wall;
  }
  double MedianSpeed(const Words& words, int runs) const {
    std::vector<double> speeds;
    for (int i = 0; i < runs; ++i) speeds.push_back(Speed(words));
    return Median(speeds);
  }
  Words Exec(const Words& command) const {
    Words words = {"exec", program_.robot, "--clock", "simulated", "--log-level", "info"};
    if (released()) words.emplace_back("--released");
    if (!program_.script.empty()) words.insert(words.end(), {"--script", program_.script});
    words.emplace_back("--");
    return Joined(words, command);
  }

  // A scenario with the program, and what `more` says.
  std::string Scenario(const std::string& more) const {
    const std::string file = folder_.path() / "clocked.yaml";
    std::ofstream(file) << "scenario: A program on the clock\nrobot: " << program_.robot
                        << "\nclock: simulated\nprogram: {limit: 600}\n"
                        << (released() ? "settings: {motion: {service: none}}\n" : "")
                        << "expect: [{final: program.exit_code is 0}]\n"
                        << FileText(program_.script) << more;
    return file;
  }

  // How many of so many pairs of runs say the same.
  Figure Pairs(const std::string& where, int pairs, double seconds) const {
    const std::string scenario = Scenario("");
    int equal = 0;
    for (int i = 0; i < pairs; ++i) {
      const int code = RunToEnd(Joined({understudy_, "rehearse", scenario, "--twice",
                                        "--no-pictures", "--out", folder_.path() / "pair", "--"},
                                       Command(seconds)));
      if (code != kRepeats && code != kDiffers) {
        throw std::runtime_error("rehearse --twice failed: exit code " + std::to_string(code));
      }
      equal += code == kRepeats ? 1 : 0;
    }
    return {.robot = program_.robot,
            .name = "equal pairs, " + where,
            .unit = "",
            .value = static_cast<double>(equal),
            .bound = pairs,
            .wanted = Wanted::kAtLeast};
  }

  Figure Rehearsals(int runs) const {
    const std::string scenario =
        Scenario("vary: {grid: {seed: {from: 1, to: " + std::to_string(runs) + "}}}\n");
    const auto begun = steady_clock::now();
    const int code =
        RunToEnd(Joined({understudy_, "rehearse", scenario, "--jobs", std::to_string(Cores()),
                         "--out", folder_.path() / "many", "--"},
                        Command(kRehearsed)));
    const double wall = std::chrono::duration<double>(steady_clock::now() - begun).count();
    if (code != 0) throw std::runtime_error("a campaign failed: exit code " + std::to_string(code));
    return {.robot = program_.robot,
            .name = "rehearsals on the clock, simulated s per s of a core",
            .unit = "",
            .value = kRehearsed * runs / wall / Cores(),
            .bound = kWantedRehearsals,
            .wanted = Wanted::kAtLeast};
  }

 private:
  std::string understudy_;
  const ClockedProgram& program_;
  TemporaryFolder folder_{"bench"};
};

}  // namespace

std::vector<Figure> MeasureClock(const std::string& understudy, const ClockedProgram& program,
                                 const ClockEffort& effort) {
  const Meter meter(understudy, program);
  const Words command = meter.Command(effort.seconds);
  std::vector<Figure> figures = {{.robot = program.robot,
                                  .name = "program on the clock, simulated s per s",
                                  .unit = "",
                                  .value = meter.MedianSpeed(meter.Exec(command), effort.speeds),
                                  .bound = program.times,
                                  .wanted = Wanted::kAtLeast}};
  // Long enough for discovery, commands and answers.
  const double pair = std::min(effort.seconds, kRehearsed);
  figures.push_back(meter.Pairs("quiet", effort.pairs, pair));
  {
    const Disturbance load(&Spin);
    figures.push_back(meter.Pairs("beside a program on every core", effort.pairs, pair));
  }
  if (!program.command.empty()) return figures;
  {
    const Disturbance load(&Flood);
    figures.push_back(meter.Pairs("beside floods of UDP", effort.flooded, pair));
  }
  figures.push_back(meter.Rehearsals(effort.rehearsals));
  const std::string seconds = Printed("%g", effort.seconds);
  const double alone = meter.MedianSpeed(meter.Exec({"sleep", seconds}), effort.speeds);
  const double most = meter.MedianSpeed(
      {"run", program.robot, "--released", "--speed", "max", "--duration", seconds}, effort.speeds);
  figures.push_back({.robot = program.robot,
                     .name = "robot alone on the clock / --speed max",
                     .unit = "",
                     .value = alone / most,
                     .bound = kWantedAlone,
                     .wanted = Wanted::kAtLeast});
  return figures;
}

}  // namespace understudy::bench
