// What the emulator shows of itself to who looks.
#include <algorithm>

#include "emulator/emulator.h"

namespace understudy::emulator {
namespace {

bool Has(const Frame& frame, FramePart part) { return (frame.parts & part) != 0; }

std::array<double, 3> Array(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

}  // namespace

Frame Emulator::MakeFrame() const {
  Frame frame;
  frame.positions.resize(physics::PositionCount(world_));
  frame.body_names = physics::BodyNames(world_);
  for (const robot::MotorSpec& motor : config_.robot.motors)
    frame.motor_names.push_back(motor.joint);
  frame.command_topics.assign(robot::kCommandTopicNames.begin(), robot::kCommandTopicNames.end());
  if (config_.robot.arm_sdk.slots.empty()) frame.command_topics[robot::kArmSdkTopic].clear();
  if (!config_.robot.user_lowcmd) frame.command_topics[robot::kUserLowCmdTopic].clear();
  for (const robot::HandSpec& hand : config_.robot.hands) {
    frame.command_topics.push_back("rt/" + hand.topic + "/cmd");
    for (const robot::MotorSpec& motor : hand.motors) frame.motor_names.push_back(motor.joint);
  }
  frame.bodies.resize(frame.body_names.size());
  frame.contacts.reserve(kMostFrameContacts);
  frame.pushes.reserve(kMostFramePushes);
  frame.motors.resize(frame.motor_names.size());
  frame.imu_count = config_.robot.imu.secondary_site.empty() ? 1 : 2;
  frame.feet.resize(config_.robot.feet.size());
  frame.command.resize(config_.robot.motors.size());
  frame.refusals.reserve(kMostFrameRefusals);
  return frame;
}

void Emulator::Show(Frame* frame) const {
  frame->step = step_;
  frame->time = time();
  frame->speed = pace_.speed;
  frame->paused = pace_.paused;
  if (Has(*frame, kPartPositions)) physics::ReadPositions(world_, frame->positions);
  if (Has(*frame, kPartBodies)) physics::ReadBodies(world_, frame->bodies);
  if (Has(*frame, kPartContacts)) {
    frame->contacts.resize(kMostFrameContacts);
    frame->contacts.resize(physics::ReadContacts(world_, frame->contacts));
  }
  if (Has(*frame, kPartCom)) {
    frame->com = physics::SubtreeCenterOfMass(world_, world_.FindBody(config_.robot.base_body));
  }
  if (Has(*frame, kPartCrane)) {
    frame->crane = {.attached = crane_.attached(),
                    .hook = Array(world_.Point(crane_body_, crane_point_).p_WP),
                    .top = Array(crane_.anchor()),
                    .tension = crane_.tension()};
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
  if (Has(*frame, kPartMotors)) {
    // Nothing has been sampled before the first tick.
    std::ranges::copy(state_.motors, frame->motors.begin());
    auto next = frame->motors.begin() + std::ssize(config_.robot.motors);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      std::ranges::copy(state_.hands[i].motors, next);
      next += std::ssize(config_.robot.hands[i].motors);
    }
  }
  frame->imus = {state_.imu, state_.secondary_imu};
  frame->battery = state_.battery;
  std::copy_n(state_.foot_force.begin(), std::min(state_.foot_force.size(), frame->feet.size()),
              frame->feet.begin());
  frame->remote = state_.remote;
  if (Has(*frame, kPartCommand)) frame->command = command_->motors;
  if (Has(*frame, kPartRefusals)) refusals_.CopyTo(&frame->refusals);
}

}  // namespace understudy::emulator
