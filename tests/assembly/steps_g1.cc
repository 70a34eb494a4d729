// Linked with understudy_assembly alone: a G1 on its crane for a second.
#include <cstdio>
#include <exception>

#include "assembly/simulation.h"
#include "config/data_dir.h"
#include "config/load.h"

int main() try {
  using namespace understudy;
  assembly::Simulation simulation(config::LoadConfig({.robot = "g1"}, config::DataDir()));
  simulation.Step(1000);
  const emulator::World& world = simulation.world();
  std::printf("t = %.3f s, the base is at %.3f m\n", world.time(),
              world.physics().robot().base().p_WB.z());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
