// Where and when a walking humanoid steps.
#pragma once

#include <Eigen/Core>

namespace understudy::motion {

// How one robot steps.
struct StepFigures {
  double rate = 1;     // 1/s, ω = √(g / z), z the height of the centre of mass over the soles
  double time = 0.3;   // s, of a step
  double width = 0.2;  // m, between the soles' centres
  double least_width = 0;  // m, the same, that keeps feet clear of each other
  double half_length = 0;  // m, of a sole
  double half_width = 0;   // m, of a sole
};

// s at the start of a step in which the old foot gives up its load: assumed.
inline constexpr double kSharedTime = 0.04;

// A step from the centre of the stance sole, in axes of the heading: x ahead, y left.
struct StepPlan {
  Eigen::Vector2d pressure{0, 0};  // m, where the stance sole is to press
  Eigen::Vector2d landing{0, 0};   // m, the next sole's centre
  double turn = 0;                 // rad, of the next sole
  double time = 0;                 // s, of this step
};

// Places feet by the capture point ξ of a linear inverted pendulum, which runs away from the centre
// of pressure p:
//
//   ξ(t) = p + (ξ - p) e^{ω t}
//
// The next foot lands where ξ will be, less where the periodic gait of the wanted velocity has it.
// A step that would have to be too long is made sooner. (Englsberger et al. 2011; step time after
// Khadiv et al. 2016.) Allocates nothing.
class StepPlanner {
 public:
  explicit StepPlanner(const StepFigures& figures) : figures_(figures), time_(figures.time) {}

  void Begin() { time_ = figures_.time; }  // a new step

  // `elapsed` [s] since the step began; `side` 1 if the left foot stands, else -1; `capture` [m]
  // the capture point; `velocity` the wanted one, m/s ahead and left, rad/s; `foot_yaw` [rad] of
  // the stance sole. Frames are StepPlan's.
  StepPlan Step(double elapsed, double side, const Eigen::Vector2d& capture,
                const Eigen::Vector3d& velocity, double foot_yaw);

  // Returns whether a step of the usual time from here lands hardly wider than usual; `capture` [m]
  // the capture point left of the stance sole.
  bool FitsAside(double side, double capture) const;

  // Returns where the capture point of the periodic gait is when a step begins.
  Eigen::Vector2d Orbit(double side, const Eigen::Vector3d& velocity) const;

  const StepFigures& figures() const { return figures_; }

 private:
  Eigen::Vector2d Landing(double remaining, double side, const Eigen::Vector2d& capture,
                          const Eigen::Vector2d& pressure, const Eigen::Vector3d& velocity) const;

  StepFigures figures_;
  double time_;  // s, of the present step
};

}  // namespace understudy::motion
