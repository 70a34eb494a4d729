// Models a robot's mainboard: how warm it gets, and the fans that cool it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "robot/fault.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::robot {

// Its two thermometers show the air's temperature and what the board's own work adds, which grows,
// as fans fail, in proportion to the share of their air that is missing, to still_air times as much
// where none turns (*assumed*). They follow with one time constant. Does not allocate.
class Board {
 public:
  // `spec` must outlive it.
  explicit Board(const RobotSpec& spec);

  // Whether a step changes nothing while no part of it has a fault.
  bool settled() const { return settled_; }
  // Goes on by dt [s]. `fans` are those of the spec, in its order.
  void Step(double dt, std::span<const FanEffects> fans, const BoardEffects& fault);

  const BoardReading& reading() const { return reading_; }

 private:
  const RobotSpec& spec_;
  double rise_ = 1;  // of the board, times what it is with all fans
  bool settled_ = true;
  BoardReading reading_;
};

}  // namespace understudy::robot
