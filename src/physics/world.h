// The simulated world around one robot. Nothing outside this folder sees MuJoCo.
#ifndef UNDERSTUDY_PHYSICS_WORLD_H_
#define UNDERSTUDY_PHYSICS_WORLD_H_

#include <span>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::physics {

// A point fixed to a body, as it is now, in the world frame.
struct PointReading {
  Eigen::Vector3d p_WP{0, 0, 0};    // m
  Eigen::Vector3d v_WP_W{0, 0, 0};  // m/s
};

// How a step went.
enum class StepHealth {
  kFine,
  kDiverged,  // a position, rate or acceleration was not finite or beyond reason; the world now
              // holds no valid state
};

// Advances by fixed steps, split so that the motor law sits between positions and forces:
//
//   BeginStep()      kinematics at t: q(), dq(), base(), Point() are of t
//   EndStep(tau)     forces at t, then the state of t + dt; Imu() and FootForces() are of t
//
// Between EndStep and the next BeginStep every reading still belongs to t. After Reset and before
// the first BeginStep readings are those of the start state; before Reset that is the pose of the
// model's file. Allocates in the constructor only.
class PhysicsWorld {
 public:
  // `model` comes from LoadWorldModel with the same spec.
  PhysicsWorld(mjcf::ModelHandle model, const robot::RobotSpec& spec);

  // Puts the robot at rest over the origin in that pose, as high over the ground that is there as
  // the pose says (LiftOntoGround). A fixed base stays where its file has it.
  void Reset(const robot::PoseSpec& pose);

  void BeginStep();

  // Torques [N·m] of a hand's motors, in HandSpec::motors order; finite. They act in the coming
  // steps until others are set or Reset.
  void DriveHand(std::size_t hand, std::span<const double> tau);

  // tau: joint torques [N·m] in motor order; finite. External forces set before act in this step
  // and are then gone.
  [[nodiscard]] StepHealth EndStep(std::span<const double> tau);

  // A force [N] on a point that is fixed to a body, for the coming EndStep. Adds up.
  void AddForce(int body, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W);

  // Holds the base where it is now, as a stand does, or lets go. A fixed base is always held.
  void Clamp(bool on);
  bool clamped() const;

  // Body index by name. Throws ModelError when there is none.
  int Body(const std::string& name) const;
  // The same without a throw: -1 when there is none.
  int FindBody(const std::string& name) const;
  Eigen::Vector3d CenterOfMass(int body) const;  // m, world; as of the last BeginStep

  // The point p [m] in the frame of a body.
  PointReading Point(int body, const Eigen::Vector3d& p_BP) const;

  // Joint angles [rad] and rates [rad/s] in motor order, and of a hand in HandSpec::motors order.
  std::span<const double> q() const { return std::span(q_).first(motors_); }
  std::span<const double> dq() const { return std::span(dq_).first(motors_); }
  std::span<const double> hand_q(std::size_t hand) const { return OfHand(hand, q_); }
  std::span<const double> hand_dq(std::size_t hand) const { return OfHand(hand, dq_); }
  const robot::BaseReading& base() const { return base_; }
  double tilt() const;  // rad between the base's up and the world's
  robot::ImuReading Imu() const { return Read(imu_); }
  robot::ImuReading SecondaryImu() const {
    return Read(secondary_imu_);
  }  // default where there is none
  // What the contacts press on each foot [N], in spec order: the part of their normal forces along
  // FootSpec::axis, never negative.
  void FootForces(std::span<double> force) const;

  double timestep() const { return model_->opt.timestep; }
  double weight() const;                                                         // N, of the robot
  double SubtreeMass(int body) const { return model_->body_subtreemass[body]; }  // kg
  // For a test or a viewer to copy from; never to write.
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 private:
  struct ImuAddress {
    int site = -1;
    int gyro = -1;  // in sensordata
    int accel = -1;
  };

  ImuAddress FindImu(const std::string& site, const char* gyro, const char* accel) const;
  robot::ImuReading Read(const ImuAddress& address) const;
  void ReadKinematics();
  bool has_fixed_base() const { return clamp_ < 0; }
  void FindJoints(const std::vector<robot::MotorSpec>& motors);
  template <typename T>
  std::span<const T> OfHand(std::size_t hand, const std::vector<T>& all) const {
    return std::span(all).subspan(hand_begin_[hand], hand_begin_[hand + 1] - hand_begin_[hand]);
  }

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  std::size_t motors_;
  std::vector<std::size_t> hand_begin_;      // where each hand begins in what follows, and the end
  std::vector<int> q_address_, dq_address_;  // in motor order, then hand by hand
  std::vector<int> foot_of_geom_;            // -1 where the geom is no foot's
  std::vector<Eigen::Vector3d> foot_axis_;
  int base_body_ = 0;
  int base_q_ = -1, base_dq_ = -1;  // of the free joint; -1 where the base is fixed
  int clamp_ = -1;                  // likewise
  ImuAddress imu_, secondary_imu_;
  std::vector<double> q_, dq_;
  robot::BaseReading base_;
};

}  // namespace understudy::physics

#endif  // UNDERSTUDY_PHYSICS_WORLD_H_
