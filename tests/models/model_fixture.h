#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <nlohmann/json.hpp>

namespace understudy::models {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, DeleteModel>;
using DataPtr = std::unique_ptr<mjData, DeleteData>;

inline const std::string kModels = std::string(UNDERSTUDY_SOURCE_DIR) + "/models/";
inline const std::string kFlat = kModels + "scene/flat.xml";

// A fixture in which every warning or error of MuJoCo fails the test.
class ModelTest : public testing::Test {
 protected:
  ModelTest();
  ~ModelTest() override;

  // Compiles one file on its own. Fails the test and returns null when it does not load cleanly.
  static ModelPtr Load(const std::string& path);
  // Compiles several files into one world, `extra` (MJCF elements) after them.
  static ModelPtr LoadTogether(const std::vector<std::string>& paths,
                               const std::string& extra = "");
};

// The robot's model as its file names it, with its hands on.
std::string ModelFile(const std::string& robot);

// tests/data/figures/<robot>.json
nlohmann::json ReadFigures(const std::string& robot);

// Id of the named object. Fails the test and returns -1 when the model lacks it.
int Id(const mjModel& model, mjtObj type, const std::string& name);

// xx yy zz xy xz yz about the centre of mass, in the body's frame.
std::vector<double> InertiaInBodyFrame(const mjModel& model, int body);

// Joint PD, torque held for one step: kp (q* - q) + kd (dq* - dq), dq* 0 unless set. All vectors
// are in SDK motor order.
class JointPd {
 public:
  JointPd(const mjModel& model, const std::vector<std::string>& joints, std::vector<double> kp,
          std::vector<double> kd);

  void SetTarget(std::vector<double> target) { target_ = std::move(target); }    // rad
  void SetTargetSpeed(std::vector<double> speed) { speed_ = std::move(speed); }  // rad/s
  void PlaceAtTarget(const mjModel& model, mjData* data) const;
  void Step(const mjModel& model, mjData* data) const;
  // Largest joint speed of the driven joints, rad/s.
  double MaxSpeed(const mjModel& model, const mjData& data) const;
  std::vector<double> Positions(const mjModel& model, const mjData& data) const;

 private:
  std::vector<int> joints_;
  std::vector<int> motors_;
  std::vector<double> kp_, kd_, target_, speed_;
};

// Angle between the z axis of a body and the vertical, degrees.
double TiltDegrees(const mjData& data, int body);

// "a touches b" for every contact within the robot; empty when it is free of itself.
std::vector<std::string> SelfContacts(const mjModel& model, const mjData& data);

}  // namespace understudy::models
