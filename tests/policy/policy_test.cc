#include "policy/policy.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/policy/files.h"

namespace understudy::policy {
namespace {

using ::testing::HasSubstr;

const std::vector<MotorName> kMotors{{"hip", 0}, {"knee", 1}, {"ankle", 4}};

// Policy order: ankle, hip, knee.
std::string Definition3(const std::string& observations, const std::string& rest = {}) {
  return "joint_ids_map: [4, 0, 1]\n"
         "step_dt: 0.02\n"
         "stiffness: [20, 30, 0, 0, 40]\n"
         "damping: [1, 2, 0, 0, 3]\n"
         "default_joint_pos: [0.1, -0.2, 0.3]\n"
         "commands: {base_velocity: {ranges: {lin_vel_x: [-0.5, 1], lin_vel_y: [-0.3, 0.3],\n"
         "                                    ang_vel_z: [-0.2, 0.2]}}}\n"
         "actions: {JointPositionAction: {scale: [0.25, 0.5, 0.75], offset: [0.1, -0.2, 0.3]}}\n"
         "observations:\n" +
         observations + rest;
}

// A network without hidden layers.
Network Linear(const Eigen::MatrixXf& weight, const Eigen::VectorXf& bias) {
  return Network({Layer{.weight = weight, .bias = bias}}, Activation::kNone);
}

// The policy of those observations whose network gives zeros, or `network`.
Policy Made(const std::string& observations, const std::string& rest = {}) {
  Definition definition = ParseDefinition(Definition3(observations, rest), "deploy.yaml");
  const auto width = static_cast<Eigen::Index>(Width(definition));
  Network network = Linear(Eigen::MatrixXf::Zero(3, width), Eigen::VectorXf::Zero(3));
  return {std::move(definition), std::move(network), kMotors, "stilt"};
}

Sensed SomeSenses() {
  Sensed sensed;
  sensed.q = Eigen::Vector3f(0.4F, -0.5F, 0.6F);  // hip, knee, ankle
  sensed.dq = Eigen::Vector3f(1.5F, -2.5F, 3.5F);
  sensed.R_WI = Eigen::Quaternionf(0.9F, 0.1F, -0.2F, 0.3F).normalized();
  sensed.w_WI_I = Eigen::Vector3f(0.11F, -0.22F, 0.33F);
  sensed.velocity = Eigen::Vector3f(2, -0.25F, -7);
  return sensed;
}

std::vector<float> Observed(const std::string& observations, const std::string& rest = {}) {
  Policy policy = Made(observations, rest);
  policy.Begin(SomeSenses());
  policy.Step(SomeSenses());
  return {policy.observation().begin(), policy.observation().end()};
}

TEST(PolicyTest, ObservesEachTermBitForBitAsComputedByHand) {
  const Sensed sensed = SomeSenses();
  const Eigen::Vector3f down = sensed.R_WI.conjugate() * Eigen::Vector3f(0, 0, -1);
  const float delta = 0.02F * (1.0F / 0.8F);
  const float phase = std::fmod(std::fmod(0.0F + delta, 1.0F) + delta, 1.0F);
  const std::pair<const char*, std::vector<float>> rows[] = {
      {"  base_ang_vel: {params: {}, scale: [0.2, 0.4, 0.6]}\n",
       {0.11F * 0.2F, -0.22F * 0.4F, 0.33F * 0.6F}},
      {"  projected_gravity: {params: {}}\n", {down.x(), down.y(), down.z()}},
      {"  velocity_commands: {params: {}, scale: 2}\n", {1 * 2.0F, -0.25F * 2.0F, -0.2F * 2.0F}},
      {"  joint_pos: {params: {}}\n", {0.6F, 0.4F, -0.5F}},
      {"  joint_pos_rel: {params: {}}\n", {0.6F - 0.1F, 0.4F - -0.2F, -0.5F - 0.3F}},
      {"  joint_pos_rel: {params: {asset_cfg: {joint_ids: [2, 0]}}}\n",
       {-0.5F - 0.3F, 0.6F - 0.1F}},
      {"  joint_vel_rel: {params: {}, clip: [-2, 3], scale: 0.05}\n",
       {3 * 0.05F, 1.5F * 0.05F, -2 * 0.05F}},
      {"  last_action: {params: {}}\n", {0, 0, 0}},
      {"  gait_phase: {params: {period: 0.8}}\n",
       {static_cast<float>(std::sin(phase * 2 * M_PI)),
        static_cast<float>(std::cos(phase * 2 * M_PI))}},
  };
  for (const auto& [observations, values] : rows) {
    EXPECT_EQ(Observed(observations), values) << observations;
  }
  EXPECT_EQ(
      Observed("  joint_vel_rel: {params: {}, clip: [-2, 3], scale: 2}\n", "  scale_first: true\n"),
      (std::vector<float>{3, 3, -2}));
}

TEST(PolicyTest, KeepsAHistoryByTermOrByStepWithTheOldestFirst) {
  const std::string terms =
      "  base_ang_vel: {params: {}, history_length: 2}\n"
      "  velocity_commands: {params: {}, history_length: 2}\n";
  for (const bool by_step : {false, true}) {
    Policy policy = Made(terms, by_step ? "  use_gym_history: true\n" : "");
    Sensed sensed = SomeSenses();
    const auto step = [&](float value) {
      sensed.w_WI_I.setConstant(value);
      sensed.velocity.setConstant(value / 100);
      policy.Step(sensed);
      std::vector<float> firsts;
      for (const Eigen::Index i : {0, 3, 6, 9}) firsts.push_back(policy.observation()[i]);
      return firsts;
    };
    sensed.w_WI_I.setConstant(1);
    sensed.velocity.setConstant(0.01F);
    policy.Begin(sensed);
    const float w = 0.01F;
    EXPECT_EQ(step(2), by_step ? (std::vector<float>{1, w, 2, 2 / 100.0F})
                               : (std::vector<float>{1, 2, w, 2 / 100.0F}));
    EXPECT_EQ(step(3), by_step ? (std::vector<float>{2, 2 / 100.0F, 3, 3 / 100.0F})
                               : (std::vector<float>{2, 3, 2 / 100.0F, 3 / 100.0F}));
  }
}

TEST(PolicyTest, ScalesOffsetsAndClipsItsActionsAndObservesTheLastOnes) {
  Definition definition = ParseDefinition(
      "joint_ids_map: [4, 0, 1]\nstep_dt: 0.02\nstiffness: [20, 30, 0, 0, 40]\n"
      "damping: [1, 2, 0, 0, 3]\ndefault_joint_pos: [0.1, -0.2, 0.3]\n"
      "actions: {JointPositionAction: {joint_ids: [2, 0], scale: [0.5, 0.25], offset: [1, 2],\n"
      "                                clip: [[-1, 1.25], [-9, 9]]}}\n"
      "observations: {joint_vel_rel: {params: {}}, last_action: {params: {}}}\n",
      "deploy.yaml");
  Eigen::MatrixXf weight = Eigen::MatrixXf::Zero(2, 5);
  weight(0, 0) = 1;  // the first action is the ankle's rate, the second 3 + the last first action
  weight(1, 3) = 1;
  Policy policy(std::move(definition), Linear(weight, Eigen::Vector2f(0, 3)), kMotors, "stilt");
  policy.Begin(SomeSenses());
  policy.Step(SomeSenses());
  const auto target = [&](std::size_t i) { return policy.targets()[i]; };
  EXPECT_EQ(policy.action(), Eigen::Vector2f(3.5F, 3));
  EXPECT_EQ(target(2).motor, 1U);
  EXPECT_EQ(target(2).q, 1.25F) << "3.5 * 0.5 + 1, clipped";
  EXPECT_EQ(target(2).kp, 30);
  EXPECT_EQ(target(2).kd, 2);
  EXPECT_EQ(target(0).motor, 2U);
  EXPECT_EQ(target(0).q, 3 * 0.25F + 2);
  EXPECT_EQ(target(0).kp, 40);
  EXPECT_EQ(target(1).motor, 0U);
  EXPECT_EQ(target(1).q, -0.2F) << "a joint without an action holds its default angle";
  policy.Step(SomeSenses());
  EXPECT_EQ(policy.action(), Eigen::Vector2f(3.5F, 6.5F));
  policy.Begin(SomeSenses());
  policy.Step(SomeSenses());
  EXPECT_EQ(policy.action(), Eigen::Vector2f(3.5F, 3)) << "it began anew";
}

TEST(PolicyTest, HoldsItsDefaultAnglesWhenTheNetworkOverflows) {
  Definition definition =
      ParseDefinition(Definition3("  joint_vel_rel: {params: {}}\n"), "deploy.yaml");
  Policy policy(std::move(definition),
                Linear(Eigen::Matrix3f::Constant(3e38F), Eigen::Vector3f::Zero()), kMotors,
                "stilt");
  policy.Begin(SomeSenses());
  policy.Step(SomeSenses());
  EXPECT_EQ(policy.action(), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(policy.targets()[0].q, 0.1F);
}

TEST(PolicyTest, FindsItsJointsByNameAndHoldsThemAgainstTheirSlots) {
  const std::string terms = "  joint_pos: {params: {}}\n";
  const auto why = [&](const std::string& joints, std::span<const MotorName> motors) {
    try {
      Definition definition = ParseDefinition(
          Definition3(terms, "understudy: {joint_names: " + joints + "}\n"), "deploy.yaml");
      Policy(std::move(definition), Linear(Eigen::Matrix3f::Zero(), Eigen::Vector3f::Zero()),
             motors, "stilt");
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(why("[ankle, hip, knee]", kMotors), "");
  EXPECT_EQ(why("[ankle, knee, hip]", kMotors),
            "deploy.yaml: joint_ids_map.1: slot 0 of stilt is hip; understudy.joint_names says "
            "knee");
  EXPECT_THAT(why("[ankle, hip, kneee]", kMotors),
              HasSubstr("understudy.joint_names.2: no motor of stilt moves a joint 'kneee'; did "
                        "you mean 'knee'?"));
}

TEST(PolicyTest, RefusesARobotOrANetworkThatDoesNotFit) {
  const auto why = [](const std::string& text, std::span<const MotorName> motors,
                      Eigen::Index inputs, Eigen::Index outputs) {
    try {
      Policy(ParseDefinition(text, "deploy.yaml"),
             Linear(Eigen::MatrixXf::Zero(outputs, inputs), Eigen::VectorXf::Zero(outputs)), motors,
             "stilt");
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string text =
      Definition3("  base_ang_vel: {params: {}, history_length: 5}\n  joint_pos: {params: {}}\n");
  EXPECT_EQ(why(text, kMotors, 18, 3), "");
  EXPECT_EQ(why(text, kMotors, 12, 3),
            "deploy.safetensors: the network takes 12 numbers; the observations of deploy.yaml are "
            "18: base_ang_vel 3 x 5, joint_pos 3");
  EXPECT_EQ(why(text, kMotors, 18, 2),
            "deploy.safetensors: the network gives 2 actions; JointPositionAction of deploy.yaml "
            "has 3");
  EXPECT_EQ(why(text, std::span(kMotors).first(2), 18, 3),
            "deploy.yaml: joint_ids_map.0: no motor of stilt is in slot 4; it has 2, the last in "
            "slot 1");
  std::string twice = text;
  twice.replace(twice.find("[4, 0, 1]"), 9, "[4, 0, 0]");
  EXPECT_EQ(why(twice, kMotors, 18, 3), "deploy.yaml: joint_ids_map.2: hip is in the list already");
  std::string gains = text;
  gains.replace(gains.find("[20, 30, 0, 0, 40]"), 18, "[20, 30, 40]");
  EXPECT_EQ(why(gains, kMotors, 18, 3),
            "deploy.yaml: stiffness: expected a number for each slot up to 4, got 3");
}

}  // namespace
}  // namespace understudy::policy
