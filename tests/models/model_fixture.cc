#include "tests/models/model_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <mujoco/mujoco.h>

#include "mjcf/mount.h"
#include "tests/support/robots.h"
#include "tests/support/temporary_folder.h"

namespace understudy::models {
namespace {

void FailOnWarning(const char* text) { ADD_FAILURE() << "MuJoCo warns: " << text; }

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << "cannot read " << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void AddFile(mjVFS* vfs, const std::string& name, const std::string& text) {
#if mjVERSION_HEADER < 300
  ASSERT_EQ(mj_makeEmptyFileVFS(vfs, name.c_str(), static_cast<int>(text.size())), 0) << name;
  const int index = mj_findFileVFS(vfs, name.c_str());
  std::copy(text.begin(), text.end(), static_cast<char*>(vfs->filedata[index]));
#else
  ASSERT_EQ(mj_addBufferVFS(vfs, name.c_str(), text.data(), static_cast<int>(text.size())), 0)
      << name;
#endif
}

std::string NameOr(const char* name) { return name == nullptr ? "?" : name; }

}  // namespace

ModelTest::ModelTest() { mju_user_warning = FailOnWarning; }
ModelTest::~ModelTest() { mju_user_warning = nullptr; }

ModelPtr ModelTest::Load(const std::string& path) {
  char error[1024] = "";
  ModelPtr model(mj_loadXML(path.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(model != nullptr) << path;
  EXPECT_STREQ(error, "") << path;
  return model;
}

ModelPtr ModelTest::LoadTogether(const std::vector<std::string>& paths, const std::string& extra) {
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  // In the folder of the first file, from where its own includes count.
  const std::filesystem::path folder = std::filesystem::path(paths.front()).parent_path();
  const std::string name = (folder / "outer.xml").string();
  std::string outer = "<mujoco>";
  for (const std::string& path : paths) {
    outer += "<include file=\"" + std::filesystem::relative(path, folder).string() + "\"/>";
  }
  AddFile(vfs.get(), name, outer + extra + "</mujoco>");
  char error[1024] = "";
  ModelPtr model(mj_loadXML(name.c_str(), vfs.get(), error, sizeof(error)));
  mj_deleteVFS(vfs.get());
  EXPECT_TRUE(model != nullptr);
  EXPECT_STREQ(error, "");
  return model;
}

std::string ModelFile(const std::string& robot) {
  const robot::RobotSpec& spec = test::ShippedRobot(robot);
  if (spec.hands.empty()) return kModels + spec.model;
  mjcf::MjcfElement root = mjcf::ReadMjcf(kModels + spec.model);
  std::vector<mjcf::MjcfElement> hands;
  for (const robot::HandSpec& hand : spec.hands) {
    for (const std::string& model : hand.models) hands.push_back(mjcf::ReadMjcf(kModels + model));
  }
  mjcf::MountHands(spec, std::move(hands), &root);
  static const test::TemporaryFolder folder;
  return folder.Write(robot + ".xml", mjcf::WriteMjcf(root).xml);
}

nlohmann::json ReadFigures(const std::string& robot) {
  return nlohmann::json::parse(
      ReadText(std::string(UNDERSTUDY_SOURCE_DIR) + "/tests/data/figures/" + robot + ".json"));
}

int Id(const mjModel& model, mjtObj type, const std::string& name) {
  const int id = mj_name2id(&model, type, name.c_str());
  EXPECT_GE(id, 0) << "no " << mju_type2Str(type) << " named " << name;
  return id;
}

// R diag(I) R^T
std::vector<double> InertiaInBodyFrame(const mjModel& model, int body) {
  std::array<mjtNum, 9> r{};
  mju_quat2Mat(r.data(), model.body_iquat + 4 * body);
  const mjtNum* d = model.body_inertia + 3 * body;
  const auto at = [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += r[3 * i + k] * d[k] * r[3 * j + k];
    return sum;
  };
  return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)};
}

JointPd::JointPd(const mjModel& model, const std::vector<std::string>& joints,
                 std::vector<double> kp, std::vector<double> kd)
    : kp_(std::move(kp)),
      kd_(std::move(kd)),
      target_(joints.size(), 0.0),
      speed_(joints.size(), 0.0) {
  for (const std::string& joint : joints) {
    joints_.push_back(Id(model, mjOBJ_JOINT, joint));
    motors_.push_back(Id(model, mjOBJ_ACTUATOR, joint.substr(0, joint.rfind("_joint"))));
  }
}

void JointPd::PlaceAtTarget(const mjModel& model, mjData* data) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    data->qpos[model.jnt_qposadr[joints_[i]]] = target_[i];
  }
}

void JointPd::Step(const mjModel& model, mjData* data) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double q = data->qpos[model.jnt_qposadr[joints_[i]]];
    const double dq = data->qvel[model.jnt_dofadr[joints_[i]]];
    data->ctrl[motors_[i]] = kp_[i] * (target_[i] - q) + kd_[i] * (speed_[i] - dq);
  }
  mj_step(&model, data);
}

double JointPd::MaxSpeed(const mjModel& model, const mjData& data) const {
  double speed = 0;
  for (const int joint : joints_) {
    speed = std::max(speed, std::abs(data.qvel[model.jnt_dofadr[joint]]));
  }
  return speed;
}

std::vector<double> JointPd::Positions(const mjModel& model, const mjData& data) const {
  std::vector<double> q;
  for (const int joint : joints_) q.push_back(data.qpos[model.jnt_qposadr[joint]]);
  return q;
}

double TiltDegrees(const mjData& data, int body) {
  return std::acos(std::clamp(data.xmat[9 * body + 8], -1.0, 1.0)) * 180.0 / mjPI;
}

std::vector<std::string> SelfContacts(const mjModel& model, const mjData& data) {
  std::vector<std::string> touching;
  for (int i = 0; i < data.ncon; ++i) {
    const int a = model.geom_bodyid[data.contact[i].geom1];
    const int b = model.geom_bodyid[data.contact[i].geom2];
    if (a == 0 || b == 0) continue;  // the world: ground
    touching.push_back(NameOr(mj_id2name(&model, mjOBJ_BODY, a)) + " touches " +
                       NameOr(mj_id2name(&model, mjOBJ_BODY, b)));
  }
  return touching;
}

}  // namespace understudy::models
