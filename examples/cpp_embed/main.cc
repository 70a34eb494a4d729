// A Go2 in this process, without a network: its own program holds it on its feet with LowCmd.
#include <cstdio>
#include <exception>
#include <vector>

#include <understudy/assembly/simulation.h>
#include <understudy/config/data_dir.h>
#include <understudy/config/load.h>
#include <understudy/robot/command_topics.h>

namespace {

using namespace understudy;

// Commands the motors to hold the angles at which the robot was when it began.
class Hold final : public assembly::NullPort {
 public:
  explicit Hold(const config::Config& config)
      : NullPort(config.robots[0].spec, config.physics.timestep) {}

  // Called in each step until it returns false; takes at most one command per state.
  bool Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) override {
    if (topic != robot::kLowCmdTopic || !fresh_) return false;
    fresh_ = false;
    *form = robot::Refusal::kNone;
    command->motors.clear();
    for (const double q : angles_) {
      command->motors.push_back({.enabled = true, .q = q, .kp = 60, .kd = 3});
    }
    return true;
  }

  // Called when a message of the robot is due, so also with each LowState.
  void Publish(const robot::RobotState& state, std::int64_t) override {
    if (angles_.empty()) {
      for (const robot::MotorReading& motor : state.motors) angles_.push_back(motor.q);
    }
    fresh_ = true;
  }

 private:
  std::vector<double> angles_;  // rad, in the order of the motors
  bool fresh_ = false;          // a state has come since the last command
};

}  // namespace

int main() try {
  const config::Config config = config::LoadConfig(
      {.robot = "go2", .sets = {"start.pose=standing", "motion.service=none"}}, config::DataDir());
  Hold hold(config);
  assembly::Simulation simulation(config, [&](std::size_t) { return emulator::Ports{&hold}; });
  for (int tenth = 0; tenth <= 20; ++tenth) {
    if (tenth == 10) simulation.Request("push", {{"impulse", {0, 5, 0}}, {"for", 0.1}});
    const physics::RobotBody& body = simulation.world().physics().robot(0);
    std::printf("t = %.1f s: the base is %.3f m high\n", simulation.world().time(),
                body.base().p_WB.z());
    simulation.Step(100);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
