#include "stepping.h"

#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>
#include <thread>

#include <mujoco/mujoco.h>

#include "client.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "config/model_files.h"
#include "physics/crane.h"
#include "physics/world_model.h"
#include "process.h"

namespace understudy::bench {
namespace {

using Wall = std::chrono::steady_clock;

constexpr double kWantedShare = 0.9;
constexpr int kSettle = 1000;  // steps until contacts and tether carry the robot

double ThreadCpu() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

struct Speed {
  double wall = 0;  // steps per s
  double cpu = 0;   // steps per s of CPU of the stepping thread
};

// MuJoCo and nothing else.
class BareLoop {
 public:
  explicit BareLoop(const config::Config& config)
      : model_(physics::LoadWorldModel({{config.robot, config::ModelFile(config.robot)}},
                                       config::SceneFile(config.scene, config.terrain).path(),
                                       config.physics.timestep)),
        data_(mj_makeData(model_.get())),
        crane_(config.crane),
        hangs_(config.start.pose == "hanging"),
        damping_(config.gate.damping_kd),
        body_(mj_name2id(model_.get(), mjOBJ_BODY, config.robot.crane_body.c_str())),
        hook_(config.robot.crane_point) {
    const robot::RobotSpec& robot = config.robot;
    const robot::PoseSpec& pose = hangs_ ? robot.hanging : robot.standing;
    for (std::size_t i = 0; i < robot.motors.size(); ++i) {
      const robot::MotorSpec& motor = robot.motors[i];
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, motor.joint.c_str());
      joints_.push_back({.q = model_->jnt_qposadr[joint],
                         .dq = model_->jnt_dofadr[joint],
                         .wanted = pose.q[i],
                         .kp = hangs_ ? 0 : motor.hold_kp,
                         .kd = hangs_ ? damping_ : motor.hold_kd});
      data_->qpos[joints_.back().q] = pose.q[i];
    }
    const int base = mj_name2id(model_.get(), mjOBJ_BODY, robot.base_body.c_str());
    mjtNum* free = data_->qpos + model_->jnt_qposadr[model_->body_jntadr[base]];
    free[0] = free[1] = 0;
    free[2] = pose.height;
    mju_copy4(free + 3, pose.quat.data());
    mj_forward(model_.get(), data_.get());
    if (hangs_) {
      crane_.Attach(Hook().p_WP, model_->body_subtreemass[base] * mju_norm3(model_->opt.gravity));
    }
    for (int i = 0; i < kSettle; ++i) Step();
  }

  Speed Run(double window) {
    const double cpu = ThreadCpu();
    const Wall::time_point start = Wall::now();
    double wall = 0;
    std::int64_t steps = 0;
    do {
      for (int i = 0; i < 100; ++i) Step();
      steps += 100;
      wall = std::chrono::duration<double>(Wall::now() - start).count();
    } while (wall < window);
    const auto count = static_cast<double>(steps);
    return {.wall = count / wall, .cpu = count / (ThreadCpu() - cpu)};
  }

 private:
  struct Joint {
    int q, dq;
    double wanted, kp, kd;
  };

  void Step() {
    mj_step1(model_.get(), data_.get());
    for (const Joint& joint : joints_) {
      data_->qfrc_applied[joint.dq] =
          joint.kp * (joint.wanted - data_->qpos[joint.q]) - joint.kd * data_->qvel[joint.dq];
    }
    if (hangs_) {
      const physics::PointReading hook = Hook();
      const Eigen::Vector3d force = crane_.Step(hook, model_->opt.timestep);
      const Eigen::Map<const Eigen::Vector3d> centre(data_->xipos + 3 * body_);
      const Eigen::Vector3d torque = (hook.p_WP - centre).cross(force);
      mju_copy3(data_->xfrc_applied + 6 * body_, force.data());
      mju_copy3(data_->xfrc_applied + 6 * body_ + 3, torque.data());
    }
    mj_step2(model_.get(), data_.get());
  }

  physics::PointReading Hook() const {
    const Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>> R_WB(data_->xmat +
                                                                              9 * body_);
    const Eigen::Vector3d offset = R_WB * hook_;
    mjtNum v[6];  // angular, linear
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body_, v, 0);
    return {.p_WP = Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body_) + offset,
            .v_WP_W = Eigen::Vector3d(v[3], v[4], v[5]) +
                      Eigen::Vector3d(v[0], v[1], v[2]).cross(offset)};
  }

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  physics::Crane crane_;
  bool hangs_;
  double damping_;
  int body_;
  Eigen::Vector3d hook_;
  std::vector<Joint> joints_;
};

// Lets a stopped daemon run for a while.
Speed Run(const Daemon& daemon, double window) {
  daemon.process().Continue();
  const std::int64_t steps = daemon.Steps();
  const double cpu = daemon.process().CpuOfFirstThread();
  const Wall::time_point begin = Wall::now();
  std::this_thread::sleep_for(std::chrono::duration<double>(window));
  const auto count = static_cast<double>(daemon.Steps() - steps);
  const double cpu_used = daemon.process().CpuOfFirstThread() - cpu;
  const double wall = std::chrono::duration<double>(Wall::now() - begin).count();
  daemon.process().Stop();
  return {.wall = count / wall, .cpu = count / cpu_used};
}

}  // namespace

std::vector<Figure> MeasureStepping(const std::string& understudy, const std::string& robot,
                                    const std::string& start, bool listener, int rounds,
                                    double window) {
  const config::Config config =
      config::LoadConfig({.robot = robot, .sets = {"start.pose=" + start}}, config::DataDir());
  BareLoop bare(config);
  std::optional<Process> client;
  if (listener) client.emplace(HelperArguments("listen", robot));

  const Daemon daemon(understudy, robot, {"--speed", "max", "--start", start});
  daemon.AwaitReady();
  while (daemon.Steps() < kSettle) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  daemon.process().Stop();

  std::vector<double> bare_wall, daemon_wall, share_wall, share_cpu;
  for (int round = 0; round < rounds; ++round) {
    const Speed theirs = bare.Run(window);
    const Speed ours = Run(daemon, window);
    bare_wall.push_back(theirs.wall);
    daemon_wall.push_back(ours.wall);
    share_wall.push_back(ours.wall / theirs.wall);
    share_cpu.push_back(ours.cpu / theirs.cpu);
  }
  const std::string how = start + (listener ? ", one reader" : "");
  std::vector<Figure> figures;
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& values) {
    figures.push_back({.robot = robot,
                       .name = name + (", " + start) + (listener ? ", one reader" : ""),
                       .unit = unit,
                       .value = Median(values)});
  };
  if (!listener) add("bare MuJoCo", "steps/s", bare_wall);
  add("whole daemon", "steps/s", daemon_wall);
  add("daemon / bare per CPU", "", share_cpu);
  add("daemon / bare", "", share_wall);
  if (!listener) {
    figures.back().bound = kWantedShare;
    figures.back().wanted = Wanted::kAtLeast;
  }
  return figures;
}

}  // namespace understudy::bench
