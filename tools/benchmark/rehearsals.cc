#include "rehearsals.h"

#include <chrono>
#include <fstream>
#include <stdexcept>

#include "base/temporary_folder.h"
#include "process.h"

namespace understudy::bench {
namespace {

constexpr double kWantedSpeed = 15;  // times real time, of a core
constexpr int kSeconds = 10;         // simulated, of a run

}  // namespace

std::vector<Figure> MeasureRehearsals(const std::string& understudy, const std::string& robot,
                                      int runs) {
  const TemporaryFolder folder("bench");
  const std::string scenario = folder.path() / "listens.yaml";
  std::ofstream(scenario) << "scenario: It only listens\nrobot: " << robot
                          << "\nduration: " << kSeconds
                          << "\nexpect: [{never: base.tilt > 45 deg}]\n"
                             "vary: {grid: {seed: {from: 1, to: "
                          << runs << "}}}\n";
  const int cores = Cores();
  const double cpu = CpuOfChildren();
  const auto begun = std::chrono::steady_clock::now();
  const int code = RunToEnd({understudy, "rehearse", scenario, "--out", folder.path() / "out",
                             "--jobs", std::to_string(cores)});
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  if (code != 0) throw std::runtime_error("a rehearsal failed: exit code " + std::to_string(code));
  const double simulated = static_cast<double>(kSeconds) * runs;
  return {{.robot = robot,
           .name = "rehearsals, simulated s per s of a core",
           .unit = "",
           .value = simulated / wall / cores,
           .bound = kWantedSpeed,
           .wanted = Wanted::kAtLeast},
          {.robot = robot,
           .name = "rehearsals, simulated s per s of CPU",
           .unit = "",
           .value = simulated / (CpuOfChildren() - cpu)}};
}

}  // namespace understudy::bench
