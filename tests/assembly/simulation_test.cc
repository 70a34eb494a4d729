#include "assembly/simulation.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "config/load.h"
#include "perception/nearest_obstacle.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::assembly {
namespace {

config::Config ConfigOf(const std::string& robot, std::vector<std::string> sets = {}) {
  return config::LoadConfig({.robot = robot, .sets = std::move(sets)}, UNDERSTUDY_SOURCE_DIR);
}

double HeightOf(const Simulation& simulation) {
  return simulation.world().physics().robot().base().p_WB.z();
}

class SimulationTest : public test::MujocoTest {};

TEST_F(SimulationTest, BeginsAtZeroInTheStartPose) {
  const Simulation simulation(ConfigOf("go2", {"start.pose=standing"}));
  EXPECT_EQ(simulation.world().time(), 0);
  EXPECT_NEAR(HeightOf(simulation), simulation.config().robots[0].spec.standing.height, 1e-3);
}

TEST_F(SimulationTest, ARobotWithoutPortsStandsOnItsMotionService) {
  Simulation simulation(ConfigOf("go2", {"start.pose=standing"}));
  simulation.Step(1000);
  EXPECT_NEAR(simulation.world().time(), 1, 1e-9);
  EXPECT_NEAR(HeightOf(simulation), 0.3, 0.05);
}

// The scan is of a block of 60 cm ahead of the origin.
TEST_F(SimulationTest, ARobotStandsOnAScanAndItsRaysMeetIt) {
  const test::TemporaryFolder folder;
  const std::string file = folder.Write("block.obj",
                                        "v -3 -3 0\nv 1 -3 0\nv 1 3 0\nv -3 3 0\nf 1 2 3 4\n"
                                        "v 1 -3 0.6\nv 3 -3 0.6\nv 3 3 0.6\nv 1 3 0.6\n"
                                        "f 5 6 7 8\nf 2 5 8 3\n");
  Simulation simulation(ConfigOf("go2", {"scene=" + file, "start.pose=standing"}));
  simulation.Step(1000);
  EXPECT_NEAR(HeightOf(simulation), 0.3, 0.05);
  const physics::MujocoWorld& world = simulation.world().physics();
  ASSERT_NE(world.scan(), nullptr);
  perception::NearestObstacle nearest(world, 0);
  EXPECT_NEAR(nearest.Measure(0, world.data()), 0.7, 0.15) << "the block's face";
  EXPECT_GE(mj_name2id(&*simulation.sight().Get(), mjOBJ_GEOM, "scan_0"), 0);
  const physics::MujocoWorld::Scan* const scan = world.scan();
  // Begun anew it is the same, from what was read once.
  simulation.Begin(2);
  EXPECT_EQ(simulation.world().physics().scan(), scan);
}

TEST_F(SimulationTest, ARequestIsCarriedOutBeforeTheNextStep) {
  Simulation simulation(ConfigOf("go2", {"start.pose=lying"}));
  const double lying = HeightOf(simulation);
  simulation.Request("reset", {{"pose", "standing"}});
  EXPECT_GT(HeightOf(simulation), lying + 0.1);
  EXPECT_EQ(simulation.world().time(), 0);
}

TEST_F(SimulationTest, ARefusedRequestSaysWhy) {
  Simulation simulation(ConfigOf("go2"));
  try {
    simulation.Request("puhs", {});
    ADD_FAILURE();
  } catch (const ControlError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("push"));
  }
  EXPECT_THROW(simulation.Request("crane.lower"), ControlError);  // it lies on the ground
}

// Commands each motor to give `tau`, and remembers the last state.
class TorquePort final : public NullPort {
 public:
  TorquePort(const config::Config& config, double tau, std::size_t motors = 12)
      : NullPort(config.robots[0].spec, config.physics.timestep), tau_(tau), motors_(motors) {}

  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override {
    if (topic != robot::kLowCmdTopic || std::exchange(taken_, true)) return taken_ = false;
    command->motors.assign(motors_, {.enabled = true, .tau = tau_});
    *form = robot::Refusal::kNone;
    return true;
  }
  void Publish(const robot::RobotState& state, std::int64_t) override { last = state; }

  robot::RobotState last;

 private:
  double tau_;
  std::size_t motors_;
  bool taken_ = false;
};

TEST_F(SimulationTest, APortCommandsTheRobotAndReadsItsState) {
  const config::Config config = ConfigOf("go2", {"start.pose=clamped", "motion.service=none"});
  TorquePort port(config, 2);
  Simulation simulation(config, [&port](std::size_t) { return emulator::Ports{&port}; });
  simulation.Step(20);
  EXPECT_NEAR(simulation.world().robot(0).torque()[0], 2, 0.01);
  EXPECT_EQ(port.last.motors.size(), 12u);
  EXPECT_GT(port.last.tick_ms, 0u);
}

TEST_F(SimulationTest, ACommandToAnotherNumberOfMotorsIsRefusedAndCounted) {
  for (const std::size_t motors : {3U, 20U}) {
    const config::Config config = ConfigOf("go2", {"start.pose=clamped", "motion.service=none"});
    TorquePort port(config, 2, motors);
    Simulation simulation(config, [&port](std::size_t) { return emulator::Ports{&port}; });
    simulation.Step(20);
    const authority::GateCounts counts = simulation.world().status(0).commands;
    EXPECT_EQ(counts.accepted, 0U);
    EXPECT_GE(counts.refused[static_cast<std::size_t>(robot::Refusal::kMotorCount)], 20U);
  }
}

// What a program that trains episodes counts on.
TEST_F(SimulationTest, TheSeedOfTheSensorsIsAllThatTwoEpisodesDifferBy) {
  const auto sensed = [](int seed) {
    Simulation simulation(
        ConfigOf("go2", {"start.pose=standing", "sensors.seed=" + std::to_string(seed)}));
    simulation.Step(20);
    return simulation.world().robot(0).sampled().motors[0].q;
  };
  EXPECT_EQ(sensed(7), sensed(7));
  EXPECT_NE(sensed(7), sensed(8));
}

TEST_F(SimulationTest, HasASampleAfterTheFirstStep) {
  Simulation simulation(ConfigOf("go2"));
  EXPECT_TRUE(simulation.world().robot(0).sampled().motors.empty());
  simulation.Step();
  EXPECT_EQ(simulation.world().robot(0).sampled().motors.size(), 12u);
}

TEST_F(SimulationTest, EqualSimulationsAreEqualBitForBit) {
  Simulation one(ConfigOf("go2", {"start.pose=standing"}));
  Simulation other(ConfigOf("go2", {"start.pose=standing"}));
  one.Step(300);
  for (int i = 0; i < 300; ++i) other.Step();
  EXPECT_EQ(HeightOf(one), HeightOf(other));
}

TEST_F(SimulationTest, IsOfTheConfigurationThatWasDrawn) {
  const Simulation simulation(
      ConfigOf("go2", {"randomization.seed=3", "randomization.delay=[0.001, 0.004]"}));
  ASSERT_EQ(simulation.draws().values.size(), 1u);
  EXPECT_EQ(simulation.draws().values[0].quantity, "delay");
  EXPECT_EQ(simulation.config().robots[0].spec.dynamics.delay, simulation.draws().values[0].value);
}

TEST_F(SimulationTest, EachOfSeveralRobotsHasDrawsOfItsOwnThatNameIt) {
  const Simulation simulation(config::LoadConfig(
      {.robot = "go2",
       .others = {"go2"},
       .sets = {"randomization.seed=3", "randomization.delay=[0.001, 0.004]",
                "randomization.base_com=[-0.01, 0.01]", "randomization.kp=[0.8, 1.2]"}},
      UNDERSTUDY_SOURCE_DIR));
  std::map<std::string, double> drawn;
  for (const robot::Drawn& one : simulation.draws().values) {
    drawn[one.quantity + " " + one.element] = one.value;
  }
  EXPECT_EQ(drawn.size(), 2 * (1U + 3 + 12));
  for (const char* of : {"delay ", "base_com ", "kp "}) {
    const std::string element = of == std::string("kp ")         ? "FR_calf_joint"
                                : of == std::string("base_com ") ? "x"
                                                                 : "";
    EXPECT_NE(drawn.at(of + ("go2_1/" + element)), drawn.at(of + ("go2_2/" + element))) << of;
  }
  EXPECT_EQ(simulation.config().robots[1].spec.dynamics.delay, drawn.at("delay go2_2/"));
}

// Copies a Go2's model into the folder; returns the setting that takes it from there.
std::string CopyOfModel(const test::TemporaryFolder& folder) {
  std::filesystem::copy(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "models/go2",
                        folder.path() / "go2", std::filesystem::copy_options::recursive);
  return "robot.model=" + (folder.path() / "go2/go2.xml").string();
}

TEST_F(SimulationTest, OneLikeAnotherIsItsTwinAndReadsNoModel) {
  const test::TemporaryFolder folder;
  const config::Config config = ConfigOf("go2", {CopyOfModel(folder), "sensors.seed=4"});
  Simulation first(config);
  std::filesystem::remove_all(folder.path() / "go2");
  Simulation twin(first, {});
  first.Step(200);
  twin.Step(200);
  EXPECT_EQ(first.world().robot(0).sampled().imu.f_WI_I,
            twin.world().robot(0).sampled().imu.f_WI_I);
  EXPECT_THROW(Simulation{config}, ModelError);
}

// Gives all that a robot of the seed told and did in 0.3 s.
std::vector<double> ToldBy(Simulation* simulation) {
  simulation->Request("push", {{"impulse", {0, 3, 0}}});
  simulation->Step(300);
  const emulator::World& world = simulation->world();
  std::vector<double> all = {world.time(), simulation->config().physics.timestep};
  for (std::size_t i = 0; i < world.robot_count(); ++i) {
    const robot::RobotState& state = world.robot(i).sampled();
    for (const robot::MotorReading& motor : state.motors) {
      all.insert(all.end(), {motor.q, motor.dq, motor.tau, motor.winding_c});
    }
    all.insert(all.end(), state.imu.f_WI_I.begin(), state.imu.f_WI_I.end());
    all.insert(all.end(), {state.battery.soc, world.robot(i).damage().energy});
  }
  return all;
}

TEST_F(SimulationTest, BeginsAnewAsANewOneOfThatSeedWould) {
  const std::vector<std::vector<std::string>> kinds = {
      {},
      {"randomization.mass=[0.8, 1.2]", "randomization.friction=[0.4, 1.2]",
       "randomization.kp=[0.8, 1.2]", "randomization.delay=[0.001, 0.004]"},
      {"randomization.timestep=[0.0005, 0.002]"},
      {"faults=[{component: FL_hip_joint, fault: weak, by: 0.5}]"}};
  for (const std::vector<std::string>& kind : kinds) {
    const auto sets = [&kind](int seed) {
      const std::string number = std::to_string(seed);
      std::vector<std::string> all = {"start.pose=standing", "sensors.seed=" + number};
      all.insert(all.end(), kind.begin(), kind.end());
      if (!kind.empty()) all.push_back("randomization.seed=" + number);
      return all;
    };
    Simulation simulation(ConfigOf("go2", sets(3)));
    const std::vector<double> third = ToldBy(&simulation);
    simulation.Begin(8);
    EXPECT_EQ(simulation.world().time(), 0);
    Simulation other(ConfigOf("go2", sets(8)));
    EXPECT_EQ(ToldBy(&simulation), ToldBy(&other));
    EXPECT_EQ(simulation.draws().values, other.draws().values);
    simulation.Begin(3);
    EXPECT_EQ(ToldBy(&simulation), third);
  }
}

TEST_F(SimulationTest, BeginsWhereItIsAskedTo) {
  Simulation simulation(ConfigOf("go2", {"start.pose=standing", "scene=stairs_up",
                                         "terrain.size=[8, 4]", "terrain.difficulty=0.5"}));
  const auto base = [&] { return simulation.world().physics().robot(0).base_position(); };
  const double height = base()[2];
  simulation.Begin(1, {{8.9, -1, 1}});  // on the landing: ten steps of 12 cm
  EXPECT_EQ(base()[0], 8.9);
  EXPECT_EQ(base()[1], -1);
  EXPECT_NEAR(base()[2], height + 1.2, 0.01) << "set down on the ground there";
  EXPECT_NEAR(2 * std::atan2(base()[6], base()[3]), 1, 1e-6) << "turned";
  simulation.Begin(1);
  EXPECT_EQ(base()[0], 0) << "the next time it begins where it is configured to";
}

TEST_F(SimulationTest, RefusesAPlaceOfNobodyOrNowhereAndGoesOn) {
  Simulation simulation(ConfigOf("go2"));
  simulation.Step(3);
  EXPECT_THROW(simulation.Begin(1, {{0, 0, 0}, {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(simulation.Begin(1, {{1001, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(simulation.Begin(1, {{std::nan(""), 0, 0}}), std::invalid_argument);
  EXPECT_NEAR(simulation.world().time(), 0.003, 1e-9);
}

TEST_F(SimulationTest, BeginsAnewInTheMemoryThatItHas) {
  Simulation simulation(ConfigOf("go2"));
  const mjData* const before = &simulation.world().physics().data();
  simulation.Begin(8);
  EXPECT_EQ(&simulation.world().physics().data(), before);
}

TEST_F(SimulationTest, BeginsAsAtFirstWhereTheModelOfANewTimeStepIsGone) {
  const test::TemporaryFolder folder;
  Simulation simulation(ConfigOf("go2", {CopyOfModel(folder), "randomization.seed=1",
                                         "randomization.timestep=[0.0005, 0.002]"}));
  const double timestep = simulation.config().physics.timestep;
  std::filesystem::remove_all(folder.path() / "go2");
  int refused = 0;
  for (int seed = 2; seed < 12; ++seed) {
    try {
      simulation.Begin(seed);
    } catch (const ModelError&) {
      ++refused;
      EXPECT_EQ(simulation.config().physics.timestep, timestep);
      simulation.Step(10);
      EXPECT_NEAR(simulation.world().time(), 10 * timestep, 1e-9);
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(SimulationTest, BeginsAnewWithSeveralRobots) {
  const config::Config config = config::LoadConfig(
      {.robot = "go2", .others = {"g1"}, .sets = {"sensors.seed=5"}}, UNDERSTUDY_SOURCE_DIR);
  Simulation simulation(config);
  const std::vector<double> first = ToldBy(&simulation);
  simulation.Begin(5);
  EXPECT_EQ(ToldBy(&simulation), first);
}

}  // namespace
}  // namespace understudy::assembly
