// Walks every published figure of tests/data/figures and looks it up in the compiled model.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

#include "mjcf/mujoco_hooks.h"
#include "physics/geom_extent.h"
#include "physics/world_model.h"
#include "tests/models/model_fixture.h"
#include "tests/support/robots.h"

namespace understudy::models {
namespace {

using nlohmann::json;

// The figures carry seven digits or fewer; the compiler normalises quaternions and diagonalises
// inertia in double precision.
constexpr double kRelative = 1e-6;

class ModelFiguresTest : public ModelTest, public testing::WithParamInterface<std::string> {
 protected:
  ModelFiguresTest()
      : figures_(ReadFigures(GetParam())), file_(ModelFile(GetParam())), model_(Load(file_)) {}

  void SetUp() override { ASSERT_TRUE(model_ != nullptr); }

  json figures_;
  std::string file_;
  ModelPtr model_;
};

std::vector<double> Take(const mjtNum* from, int count) {
  return std::vector<double>(from, from + count);
}

// `scale` is the size against which the relative error counts: for a component near zero that of
// the whole vector.
void ExpectVector(const std::vector<double>& got, const json& figure, const std::string& what,
                  double scale) {
  ASSERT_EQ(got.size(), figure.size()) << what;
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i], figure[i].get<double>(), kRelative * scale) << what << "[" << i << "]";
  }
}

// q and -q are the same rotation.
void ExpectRotation(const std::vector<double>& got, const json& figure, const std::string& what) {
  ASSERT_EQ(figure.size(), 4u) << what;
  double dot = 0;
  for (std::size_t i = 0; i < 4; ++i) dot += got[i] * figure[i].get<double>();
  EXPECT_NEAR(std::abs(dot), 1.0, kRelative) << what;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(got[i] * (dot < 0 ? -1 : 1), figure[i].get<double>(), kRelative)
        << what << "[" << i << "]";
  }
}

TEST_P(ModelFiguresTest, LoadsBesideTheFlatScene) {
  const ModelPtr world = LoadTogether({file_, kFlat});
  ASSERT_TRUE(world != nullptr);
  EXPECT_EQ(world->nbody, model_->nbody);
  const auto colliding = [](const mjModel& model) {  // what is only drawn may have been left out
    int count = 0;
    for (int i = 0; i < model.ngeom; ++i) {
      if (model.geom_contype[i] != 0 || model.geom_conaffinity[i] != 0) ++count;
    }
    return count;
  };
  EXPECT_EQ(colliding(*world), colliding(*model_) + 1);
  EXPECT_GE(Id(*world, mjOBJ_GEOM, "floor"), 0);
}

TEST_P(ModelFiguresTest, TotalMassIsThePublishedOne) {
  EXPECT_NEAR(mj_getTotalmass(model_.get()), figures_["total_mass"].get<double>(), 1e-5);
}

// A body without mass is but a place for shapes: the hands of a G1 with five joints to the arm.
TEST_P(ModelFiguresTest, HasThePublishedBodiesAndNoOthers) {
  int bodies = 0;
  for (int i = 1; i < model_->nbody; ++i) {
    if (model_->body_mass[i] > 0 || model_->body_jntnum[i] > 0) ++bodies;
  }
  EXPECT_EQ(bodies, static_cast<int>(figures_["bodies"].size()));
}

TEST_P(ModelFiguresTest, BodiesStandWhereTheirParentsHoldThem) {
  for (const json& body : figures_["bodies"]) {
    const std::string name = body["name"];
    const int id = Id(*model_, mjOBJ_BODY, name);
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->body_parentid[id], Id(*model_, mjOBJ_BODY, body["parent"])) << name;
    ExpectVector(Take(model_->body_pos + 3 * id, 3), body["pos"], name + " pos", 1.0);
    ExpectRotation(Take(model_->body_quat + 4 * id, 4), body["quat"], name + " quat");
  }
}

TEST_P(ModelFiguresTest, BodiesWeighWhatIsPublished) {
  for (const json& body : figures_["bodies"]) {
    const std::string name = body["name"];
    const int id = Id(*model_, mjOBJ_BODY, name);
    ASSERT_GE(id, 0);
    const double mass = body["mass"];
    EXPECT_NEAR(model_->body_mass[id], mass, kRelative * mass) << name << " mass";
    ExpectVector(Take(model_->body_ipos + 3 * id, 3), body["com"], name + " com", 0.1);
    double largest = 0;
    for (const json& entry : body["inertia"]) {
      largest = std::max(largest, std::abs(entry.get<double>()));
    }
    ExpectVector(InertiaInBodyFrame(*model_, id), body["inertia"], name + " inertia", largest);
  }
}

TEST_P(ModelFiguresTest, JointsTurnAsPublished) {
  for (const json& joint : figures_["joints"]) {
    const std::string name = joint["name"];
    const int id = Id(*model_, mjOBJ_JOINT, name);
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->jnt_type[id], mjJNT_HINGE) << name;
    EXPECT_EQ(model_->jnt_bodyid[id], Id(*model_, mjOBJ_BODY, joint["body"])) << name;
    ExpectVector(Take(model_->jnt_axis + 3 * id, 3), joint["axis"], name + " axis", 1.0);
    ExpectVector(Take(model_->jnt_pos + 3 * id, 3), joint["pos"], name + " pos", 1.0);
    EXPECT_EQ(model_->jnt_limited[id] != 0, !joint["range"].is_null()) << name;
    if (joint["range"].is_null()) continue;  // a wheel
    ExpectVector(Take(model_->jnt_range + 2 * id, 2), joint["range"], name + " range", 1.0);
  }
}

TEST_P(ModelFiguresTest, JointsResistAsPublishedOrFitted) {
  for (const json& joint : figures_["joints"]) {
    if (!joint.contains("armature")) continue;
    const std::string name = joint["name"];
    const int id = Id(*model_, mjOBJ_JOINT, name);
    ASSERT_GE(id, 0);
    const int dof = model_->jnt_dofadr[id];
    EXPECT_EQ(model_->dof_armature[dof], joint["armature"].get<double>()) << name;
    EXPECT_EQ(model_->dof_damping[dof], joint["damping"].get<double>()) << name;
    EXPECT_EQ(model_->dof_frictionloss[dof], joint["frictionloss"].get<double>()) << name;
  }
}

TEST_P(ModelFiguresTest, OnlyTheBaseIsFree) {
  EXPECT_EQ(model_->njnt, static_cast<int>(figures_["joints"].size()) + 1);
  const int base = Id(*model_, mjOBJ_JOINT, "base_joint");
  ASSERT_GE(base, 0);
  EXPECT_EQ(model_->jnt_type[base], mjJNT_FREE);
  EXPECT_EQ(model_->jnt_bodyid[base], 1);
}

TEST_P(ModelFiguresTest, MotorsStopAtThePublishedTorque) {
  EXPECT_EQ(model_->nu, static_cast<int>(figures_["joints"].size()));
  for (const json& joint : figures_["joints"]) {
    const std::string name = joint["name"];
    const int id = Id(*model_, mjOBJ_ACTUATOR, name.substr(0, name.rfind("_joint")));
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->actuator_trnid[2 * id], Id(*model_, mjOBJ_JOINT, name)) << name;
    EXPECT_EQ(model_->actuator_gear[6 * id], 1.0) << name;
    EXPECT_TRUE(model_->actuator_ctrllimited[id]) << name;
    const double limit = joint["torque_limit"];
    EXPECT_EQ(model_->actuator_ctrlrange[2 * id], -limit) << name;
    EXPECT_EQ(model_->actuator_ctrlrange[2 * id + 1], limit) << name;
  }
}

TEST_P(ModelFiguresTest, EveryMotorOfTheSdkHasAJoint) {
  std::vector<std::string> published;
  for (const json& joint : figures_["joints"]) published.push_back(joint["name"]);
  auto order = figures_["motor_order"].get<std::vector<std::string>>();
  for (const json& hand : figures_.value("hands", json::object())) {
    for (const json& joint : hand["motor_order"]) order.push_back(joint);
  }
  EXPECT_THAT(order, testing::UnorderedElementsAreArray(published));
}

TEST_P(ModelFiguresTest, ImusSitWhereTheyAreMounted) {
  for (const json& imu : figures_["imus"]) {
    const std::string name = imu["name"];
    const int id = Id(*model_, mjOBJ_SITE, name);
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->site_bodyid[id], Id(*model_, mjOBJ_BODY, imu["body"])) << name;
    ExpectVector(Take(model_->site_pos + 3 * id, 3), imu["pos"], name + " pos", 1.0);
    ExpectRotation(Take(model_->site_quat + 4 * id, 4), imu["quat"], name + " quat");
  }
}

TEST_P(ModelFiguresTest, SensorsAreThoseOfTheImusAndNothingElse) {
  EXPECT_EQ(model_->nsensor, 3 * static_cast<int>(figures_["imus"].size()));
  const std::vector<std::pair<std::string, mjtSensor>> kinds = {
      {"_gyro", mjSENS_GYRO}, {"_accel", mjSENS_ACCELEROMETER}, {"_quat", mjSENS_FRAMEQUAT}};
  for (const json& imu : figures_["imus"]) {
    const std::string name = imu["name"];
    for (const auto& [suffix, type] : kinds) {
      const int id = Id(*model_, mjOBJ_SENSOR, name + suffix);
      ASSERT_GE(id, 0);
      EXPECT_EQ(model_->sensor_type[id], type) << name + suffix;
      EXPECT_EQ(model_->sensor_objtype[id], mjOBJ_SITE) << name + suffix;
      EXPECT_EQ(model_->sensor_objid[id], Id(*model_, mjOBJ_SITE, name)) << name + suffix;
    }
  }
}

TEST_P(ModelFiguresTest, FeetAreThePublishedSpheres) {
  for (const json& foot : figures_["feet"]) {
    const std::string name = foot["name"];
    const int id = Id(*model_, mjOBJ_GEOM, name);
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->geom_type[id], mjGEOM_SPHERE) << name;
    EXPECT_EQ(model_->geom_bodyid[id], Id(*model_, mjOBJ_BODY, foot["body"])) << name;
    ExpectVector(Take(model_->geom_pos + 3 * id, 3), foot["pos"], name + " pos", 1.0);
    EXPECT_NEAR(model_->geom_size[3 * id], foot["radius"].get<double>(), 1e-9) << name;
  }
}

TEST_P(ModelFiguresTest, WheelsAreCylindersAroundTheirJoints) {
  for (const json& wheel : figures_.value("wheels", json::array())) {
    const std::string name = wheel["name"];
    const int id = Id(*model_, mjOBJ_GEOM, name);
    ASSERT_GE(id, 0);
    EXPECT_EQ(model_->geom_type[id], mjGEOM_CYLINDER) << name;
    const int body = Id(*model_, mjOBJ_BODY, wheel["body"]);
    EXPECT_EQ(model_->geom_bodyid[id], body) << name;
    EXPECT_EQ(model_->jnt_bodyid[Id(*model_, mjOBJ_JOINT, wheel["joint"])], body) << name;
    ExpectVector(Take(model_->geom_pos + 3 * id, 3), wheel["pos"], name + " pos", 1.0);
    std::array<mjtNum, 9> r{};
    mju_quat2Mat(r.data(), model_->geom_quat + 4 * id);
    EXPECT_NEAR(std::abs(r[5]), 1.0, kRelative) << name << " axis is y";
    EXPECT_NEAR(model_->geom_size[3 * id], wheel["radius"].get<double>(), 1e-9) << name;
    EXPECT_NEAR(model_->geom_size[3 * id + 1], wheel["half_width"].get<double>(), 1e-9) << name;
    int collide = 0;
    for (int g = 0; g < model_->ngeom; ++g) {
      collide += model_->geom_bodyid[g] == body && model_->geom_contype[g] != 0 ? 1 : 0;
    }
    EXPECT_EQ(collide, 1) << name << " rolls on one geom";
  }
}

// What the emulator itself does with the file, and all that a robot's description names.
TEST_P(ModelFiguresTest, LoadsAsTheEmulatorLoadsIt) {
  robot::RobotSpec spec;
  spec.name = GetParam();
  spec.base_body = figures_["bodies"][0]["name"];
  spec.crane_body = spec.base_body;
  spec.imu.site = "imu";
  for (const json& joint : figures_["motor_order"]) {
    robot::MotorSpec motor;
    motor.joint = joint;
    spec.motors.push_back(motor);
  }
  for (const char* kind : {"feet", "wheels"}) {
    for (const json& foot : figures_.value(kind, json::array())) {
      spec.feet.push_back({.name = foot["name"], .geoms = {foot["name"]}});
    }
  }
  const mjcf::ModelHandle world = physics::LoadWorldModel({{spec, file_}}, {kFlat}, 0.001);
  EXPECT_EQ(world->nbody, model_->nbody);
  const auto colliding = [](const mjModel& model) {  // what is only drawn may have been left out
    int count = 0;
    for (int i = 0; i < model.ngeom; ++i) {
      if (model.geom_contype[i] != 0 || model.geom_conaffinity[i] != 0) ++count;
    }
    return count;
  };
  EXPECT_EQ(colliding(*world), colliding(*model_) + 1);
  EXPECT_EQ(mjcf::TakeMujocoWarning(), "");
  mju_user_error = nullptr;  // ModelTest puts its own hook for warnings back
}

TEST_P(ModelFiguresTest, WhatIsDrawnNeverTouchesAndWhatTouchesIsNotDrawn) {
  for (int i = 0; i < model_->ngeom; ++i) {
    const bool collides = model_->geom_contype[i] != 0 || model_->geom_conaffinity[i] != 0;
    EXPECT_EQ(model_->geom_group[i], collides ? 3 : 2) << "geom " << i;
    if (collides) {
      EXPECT_NE(model_->geom_type[i], mjGEOM_MESH) << "geom " << i;
    }
  }
}

// Else it would float or sink. A sole may be rubber that gives.
TEST_P(ModelFiguresTest, FeetAreDrawnDownToWhereTheyTread) {
  constexpr double kRubber = 0.006;  // m
  const DataPtr data(mj_makeData(model_.get()));
  mj_kinematics(model_.get(), data.get());
  for (const json& foot : figures_["feet"]) {
    const int body = Id(*model_, mjOBJ_BODY, foot["body"]);
    double seen = 1e9;
    double touching = 1e9;
    for (int i = 0; i < model_->ngeom; ++i) {
      if (model_->geom_bodyid[i] != body) continue;
      const double low = physics::LowestPoint(*model_, *data, i);
      double& lowest = physics::Collides(*model_, i) ? touching : seen;
      lowest = std::min(lowest, low);
    }
    EXPECT_NEAR(seen, touching, kRubber) << foot["name"];
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ModelFiguresTest, testing::ValuesIn(test::Robots()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::models
