// How a quadruped that avoids obstacles changes the velocity that it is asked for.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "robot/seen_obstacles.h"

namespace understudy::motion {

// Slows down before what stands in the corridor that its body would sweep, stops before it, and
// goes round what it sees the end of. It turns as it is asked to. What it does not see it does not
// avoid. All figures are *assumed*: nobody has published what real ones do. Allocates nothing.
class Avoidance {
 public:
  // `sidesteps`: it can walk aside to go round; one on wheels stops.
  explicit Avoidance(bool sidesteps) : sidesteps_(sidesteps) {}

  // Nothing is asked for any more.
  void Rest();

  // Returns what it does, after `dt` [s], of a wish: forward, left m/s, turn rad/s.
  Eigen::Vector3d Limit(const Eigen::Vector3d& wish, const robot::SeenObstacles& seen, double dt);

 private:
  struct Round {
    double side = 0;  // 1 left, -1 right
    double turn = 0;  // rad from its way
    double free = 0;  // m
    Eigen::Vector2d along{1, 0};
  };

  std::optional<Round> RoundFrom(const Eigen::Vector2d& along, double free,
                                 const robot::SeenObstacles& seen) const;

  bool sidesteps_;
  double waited_ = 0;    // s for the first cloud
  double side_ = 0;      // on which it goes round; 0: none
  double straight_ = 0;  // s that it has not had to
};

// Returns how far [m] a Go2's outline can go along a unit vector of its level frame before it meets
// a point; ObstacleMap's reach if there is none.
double FreeWay(const Eigen::Vector2d& along, const robot::SeenObstacles& seen);

}  // namespace understudy::motion
