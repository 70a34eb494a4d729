// Whole ticks of the fixture robot between a fake port and an inbox.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/make_world.h"
#include "emulator/told_event.h"
#include "emulator/world.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/requests.h"

namespace understudy::emulator {

class EmulatorTest : public test::MujocoTest {
 protected:
  // Makes the robot of config_. Tests change config_ before.
  void Start() { world_ = Make(&port_, &inbox_, &services_); }
  void StartAs(const char* pose) {
    config_.robots[0].start.pose = pose;
    Start();
  }

  // Another world with the robot of config_.
  std::unique_ptr<World> Make(wire::RobotPort* port, Inbox* inbox,
                              services::ServicePort* services = nullptr) const {
    return MakeIn(test::FixtureWorld(config_.robots[0].spec, config_.physics.timestep), port, inbox,
                  services);
  }
  std::unique_ptr<World> MakeIn(physics::MujocoWorld physics, wire::RobotPort* port, Inbox* inbox,
                                services::ServicePort* services = nullptr) const {
    return assembly::MakeWorld(
        std::move(physics), config_,
        [=](std::size_t) {
          return emulator::Ports{port, services};
        },
        inbox);
  }

  Robot& robot() const { return world_->robot(0); }

  // Ticks that must go well.
  void Tick(int times = 1) {
    for (int i = 0; i < times; ++i) ASSERT_EQ(world_->Tick({}), physics::StepHealth::kFine);
  }

  // The next tick carries it out; nobody waits for the answer.
  void Ask(std::string_view name, const nlohmann::json& values = {}) {
    inbox_.Put(test::RequestOf(name, values));
  }
  // What the next tick answers; "" when it is done.
  std::string Answered(std::string_view name, const nlohmann::json& values = {}) {
    auto asked = inbox_.Put(test::RequestOf(name, values));
    Tick();
    return asked->answer.get().why();
  }

  // What has been told so far of that kind, oldest first.
  std::vector<std::string> Told(EventKind kind) const {
    std::vector<std::string> told;
    EventRing::Reader reader(&world_->events());
    for (Event event; reader.Next(&event);) {
      if (event.kind == kind) told.push_back(ToldEvent{.event = event}.text());
    }
    return told;
  }

  double Height() const { return world_->physics().robot().base().p_WB.z(); }

  // The same torque for every motor.
  static robot::RobotCommand Torque(double tau) {
    return {.motors = std::vector<robot::MotorCommand>(6, {.enabled = true, .tau = tau})};
  }

  config::Config config_ = test::FixtureConfig();
  test::FakePort port_;
  test::FakeServices services_;
  Inbox inbox_;
  std::unique_ptr<World> world_;
};

}  // namespace understudy::emulator
