// Every hardware revision of the G1 as the emulator compiles it, against the vendor's table and the
// files it names: tests/data/figures/g1_revisions.json has what differs from the robot's base.

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "config/load.h"
#include "config/robot_file.h"
#include "physics/world_model.h"
#include "tests/models/model_fixture.h"

namespace understudy::models {
namespace {

using nlohmann::json;

constexpr double kRelative = 1e-6;  // as of the base's figures
constexpr double kGram = 1e-3;

const std::filesystem::path kData(UNDERSTUDY_SOURCE_DIR);

const json& Revisions() {
  static const json revisions = ReadFigures("g1_revisions")["revisions"];
  return revisions;
}

std::vector<std::string> RevisionsOfTable() {
  std::vector<std::string> names;
  for (const auto& [name, figures] : Revisions().items()) names.push_back(name);
  return names;
}

class G1RevisionTest : public ModelTest, public testing::WithParamInterface<std::string> {
 protected:
  ~G1RevisionTest() override { mju_user_error = nullptr; }

  bool locked() const { return figures_["waist_locked"]; }
  bool has(const std::string& joint) const {
    return !locked() || (joint != "waist_roll_joint" && joint != "waist_pitch_joint");
  }
  // The base's figure with what the revision says otherwise of it laid over.
  json Body(json body) const {
    for (const json& other : figures_["bodies"]) {
      if (other["name"] == body["name"]) body.update(other);
    }
    return body;
  }
  double TorqueLimit(const json& joint) const {
    return figures_["torque_limits"].value(joint["name"].get<std::string>(),
                                           joint["torque_limit"].get<double>());
  }
  const robot::MotorSpec* Motor(const std::string& joint) const {
    const auto found = std::ranges::find(spec_.motors, joint, &robot::MotorSpec::joint);
    return found == spec_.motors.end() ? nullptr : &*found;
  }
  double Armature(const std::string& joint) const {
    return model_->dof_armature[model_->jnt_dofadr[Id(*model_, mjOBJ_JOINT, joint)]];
  }

  const json& figures_ = Revisions()[GetParam()];
  const std::string robot_ = figures_["robot"];
  json base_ = ReadFigures(robot_);
  robot::RobotSpec spec_ =
      config::LoadConfig({.robot = robot_, .files = {}, .sets = {"robot.revision=" + GetParam()}},
                         kData)
          .robots[0]
          .spec;
  mjcf::ModelHandle model_ =
      physics::LoadWorldModel({{spec_, kModels + spec_.model}}, {kFlat}, 0.001);
};

void ExpectNumbers(const mjtNum* got, const json& figure, double scale, const std::string& what) {
  for (std::size_t i = 0; i < figure.size(); ++i) {
    EXPECT_NEAR(got[i], figure[i].get<double>(), kRelative * scale) << what << "[" << i << "]";
  }
}

TEST_P(G1RevisionTest, AnnouncesTheModeMachineOfTheTable) {
  EXPECT_EQ(std::to_string(spec_.mode_machine), GetParam());
}

TEST_P(G1RevisionTest, BodiesStandAndWeighAsInTheFileOfTheTable) {
  for (const json& base : base_["bodies"]) {
    const json body = Body(base);
    const std::string name = body["name"];
    const int id = Id(*model_, mjOBJ_BODY, name);
    ASSERT_GE(id, 0);
    ExpectNumbers(model_->body_pos + 3 * id, body["pos"], 1, name + " pos");
    EXPECT_NEAR(model_->body_mass[id], body["mass"], kRelative * body["mass"].get<double>())
        << name;
    ExpectNumbers(model_->body_ipos + 3 * id, body["com"], 0.1, name + " com");
    const auto inertia = body["inertia"].get<std::vector<double>>();
    const double largest = *std::ranges::max_element(inertia);
    ExpectNumbers(InertiaInBodyFrame(*model_, id).data(), body["inertia"], largest,
                  name + " inertia");
  }
}

// The vendor's URDFs have a link of 1 g without a shape at the pelvis, or leave it out; ours follow
// the MJCF of the base, which has it in the torso.
TEST_P(G1RevisionTest, WeighsWhatTheFileWeighs) {
  EXPECT_NEAR(mj_getTotalmass(model_.get()), figures_["total_mass"].get<double>(), 1.1 * kGram);
}

TEST_P(G1RevisionTest, MotorsStopAtTheTorqueOfTheFileAndPassItsSpeed) {
  std::size_t motors = 0;
  for (const json& joint : base_["joints"]) {
    const std::string name = joint["name"];
    const robot::MotorSpec* motor = Motor(name);
    ASSERT_EQ(motor != nullptr, has(name)) << name;
    if (motor == nullptr) continue;
    ++motors;
    EXPECT_EQ(motor->torque_limit, TorqueLimit(joint)) << name;
    if (!figures_["velocities"].contains(name)) continue;
    const double velocity = figures_["velocities"][name];
    EXPECT_LT(motor->knee_speed, velocity) << name;
    EXPECT_GT(motor->no_load_speed, velocity) << name;
  }
  EXPECT_EQ(motors, spec_.motors.size());
}

TEST_P(G1RevisionTest, MotorsKeepTheirSlotsInTheOrderOfTheSdk) {
  const json sdk = ReadFigures("g1")["motor_order"];  // index = slot
  int last = -1;
  for (const robot::MotorSpec& motor : spec_.motors) {
    EXPECT_EQ(sdk[static_cast<std::size_t>(motor.slot)], motor.joint);
    EXPECT_GT(motor.slot, last);
    last = motor.slot;
  }
}

TEST_P(G1RevisionTest, ALockedWaistHasNoJointThatCouldMove) {
  for (const char* joint : {"waist_roll_joint", "waist_pitch_joint"}) {
    const bool is_there = mj_name2id(model_.get(), mjOBJ_JOINT, joint) >= 0;
    EXPECT_EQ(is_there, robot_ == "g1" && !locked()) << joint;
  }
  EXPECT_EQ(model_->njnt, static_cast<int>(spec_.motors.size()) + 1);
  EXPECT_EQ(model_->nu, static_cast<int>(spec_.motors.size()));
}

TEST_P(G1RevisionTest, ParallelPairsAreThoseOfTheJointsThatItHas) {
  EXPECT_EQ(spec_.parallel.size(), robot_ == "g1" && !locked() ? 3U : 2U);
  for (const robot::ParallelSpec& pair : spec_.parallel) {
    const std::string& pitch = spec_.motors[static_cast<std::size_t>(pair.pitch)].joint;
    const std::string& roll = spec_.motors[static_cast<std::size_t>(pair.roll)].joint;
    EXPECT_EQ(pitch.substr(0, pitch.find("_pitch")), roll.substr(0, roll.find("_roll")));
  }
}

// Rotor inertia at the joint goes with the square of the ratio: knee and hip have the same motors.
TEST_P(G1RevisionTest, RotorsWeighWithTheGearsOfTheTable) {
  const double at_22_5 = Armature("left_knee_joint");
  const double at_14_3 = Armature("left_hip_yaw_joint");
  for (const std::string side : {"left", "right"}) {
    for (const std::string axis : {"pitch", "roll"}) {
      const double gear = figures_["hip_" + axis + "_gear"];
      const double expected = gear > 20 ? at_22_5 : at_14_3 * gear * gear / (14.3 * 14.3);
      EXPECT_NEAR(Armature(side + "_hip_" + axis + "_joint"), expected, 1e-3 * expected)
          << side << axis;
    }
  }
}

TEST_P(G1RevisionTest, ImusSitWhereTheFileHasThem) {
  for (const json& imu : base_["imus"]) {
    const std::string name = imu["name"];
    const int id = Id(*model_, mjOBJ_SITE, name);
    ASSERT_GE(id, 0);
    ExpectNumbers(model_->site_pos + 3 * id, figures_["sites"].value(name, imu["pos"]), 1, name);
    EXPECT_EQ(model_->site_bodyid[id], Id(*model_, mjOBJ_BODY, imu["body"]));
  }
}

INSTANTIATE_TEST_SUITE_P(Table, G1RevisionTest, testing::ValuesIn(RevisionsOfTable()),
                         [](const auto& test) { return "mode_machine_" + test.param; });

TEST(G1RevisionsTest, EveryRobotOffersThoseOfTheTableAndNoOthers) {
  for (const std::string robot : {"g1", "g1_23dof"}) {
    std::set<std::string> of_table;
    for (const auto& [name, figures] : Revisions().items()) {
      if (figures["robot"] == robot) of_table.insert(name);
    }
    const std::vector<std::string> names = config::ReadRobotFile(robot, kData).RevisionNames();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), of_table);
    const config::Config config =
        config::LoadConfig({.robot = robot, .files = {}, .sets = {}}, kData);
    EXPECT_EQ(config.robots[0].spec.revision, robot == "g1" ? "5" : "4");
  }
}

}  // namespace
}  // namespace understudy::models
