// What the world shows of itself to who looks.
#include <algorithm>

#include "emulator/world.h"

namespace understudy::emulator {
namespace {

static_assert(kMostFramePushes >= physics::Pushes::kMost + physics::Drags::kMost,
              "a frame with all of them would allocate");

bool Has(const Frame& frame, FramePart part) { return (frame.parts & part) != 0; }

std::array<double, 3> Array(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

}  // namespace

Frame World::MakeFrame() const {
  const robot::RobotSpec& spec = robot().spec();
  Frame frame;
  frame.positions.resize(physics::PositionCount(physics_));
  frame.body_names = physics::BodyNames(physics_);
  for (const robot::MotorSpec* motor : robot::AllMotors(spec)) {
    frame.motor_names.push_back(motor->joint);
  }
  frame.command_topics = robot().topics();
  frame.bodies.resize(frame.body_names.size());
  frame.contacts.reserve(kMostFrameContacts);
  frame.pushes.reserve(kMostFramePushes);
  frame.motors.resize(frame.motor_names.size());
  frame.imu_count = spec.imu.secondary_site.empty() ? 1 : 2;
  frame.feet.resize(spec.feet.size());
  frame.command.resize(frame.motor_names.size());
  return frame;
}

void World::Show(Frame* frame) const {
  const Robot& robot = this->robot();
  const robot::RobotSpec& spec = robot.spec();
  const robot::RobotState& state = robot.sampled();
  frame->step = step_;
  frame->time = time();
  frame->speed = pace_.speed;
  frame->paused = pace_.paused;
  if (Has(*frame, kPartPositions)) physics::ReadPositions(physics_, frame->positions);
  if (Has(*frame, kPartBodies)) physics::ReadBodies(physics_, frame->bodies);
  if (Has(*frame, kPartContacts)) {
    frame->contacts.resize(kMostFrameContacts);
    frame->contacts.resize(physics::ReadContacts(physics_, frame->contacts));
  }
  if (Has(*frame, kPartCom)) {
    frame->com = physics::SubtreeCenterOfMass(physics_, physics_.FindBody(spec.base_body));
  }
  if (Has(*frame, kPartCrane)) {
    frame->crane = {.attached = robot.crane().attached(),
                    .hook = Array(robot.hook().p_WP),
                    .top = Array(robot.crane().anchor()),
                    .tension = robot.crane().tension()};
  }
  if (Has(*frame, kPartPushes)) {
    frame->pushes.clear();
    for (const auto& forces : {pushes(), drags()}) {
      for (const physics::AppliedForce& force : forces) {
        frame->pushes.push_back(
            {.body = force.body, .at = Array(force.p_WP), .force = Array(force.force_W)});
      }
    }
  }
  // Nothing has been sampled before the first tick.
  if (Has(*frame, kPartMotors)) std::ranges::copy(state.motors, frame->motors.begin());
  frame->imus = {state.imu, state.secondary_imu};
  frame->battery = state.battery;
  std::copy_n(state.foot_force.begin(), std::min(state.foot_force.size(), frame->feet.size()),
              frame->feet.begin());
  frame->remote = state.remote;
  if (Has(*frame, kPartCommand)) frame->command = robot.command().motors;
}

}  // namespace understudy::emulator
