// Where an object that walks along its path is, by time alone.
#pragma once

#include <vector>

#include "objects/object_kinds.h"

namespace understudy::objects {

struct WalkPose {
  double x = 0, y = 0;    // m, world: the middle of its underside
  double yaw = 0;         // rad: it looks where it goes
  double vx = 0, vy = 0;  // m/s, world
  double turn = 0;        // rad/s about z
  // Of the left leg about the hips' y axis, and the right one's but for the sign: rad, rad/s.
  double swing = 0, swing_rate = 0;
};

// Walks straight from corner to corner at one speed. In a corner it turns on the spot to where it
// goes next, then waits, then goes. Legs hang down where it stands. Walks of equal objects are
// equal bit by bit.
class Walk {
 public:
  static constexpr double kTurnRate = 2;  // rad/s, *assumed*

  // Of an object with a path, whose corners differ from those before, and a speed.
  explicit Walk(const ObjectSpec& object);

  // Returns its pose `t` seconds after the start. Allocates nothing.
  WalkPose At(double t) const;
  // Returns after how many seconds it begins again; when it stays at its end, when it is there.
  double period() const { return period_; }

 private:
  // From `from` [s] on, at constant rates.
  struct Stretch {
    double from;
    WalkPose start;
    double length = 0;  // m
  };

  void Swing(double walked, const Stretch& stretch, WalkPose* pose) const;

  GaitSpec gait_;
  std::vector<Stretch> stretches_;
  double period_ = 0, begins_ = 0;  // s
  bool stays_;
};

}  // namespace understudy::objects
