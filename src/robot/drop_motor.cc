#include "robot/drop_motor.h"

#include <vector>

namespace understudy::robot {

void DropMotor(std::size_t i, RobotSpec* spec) {
  const auto at = static_cast<std::ptrdiff_t>(i);
  HumanoidMotionSpec& humanoid = spec->motion.humanoid;
  for (std::vector<double>* q :
       {&spec->lying.q, &spec->standing.q, &spec->hanging.q, &humanoid.squat_q, &humanoid.sit_q}) {
    if (q->size() == spec->motors.size()) q->erase(q->begin() + at);
  }
  std::erase(spec->arm_sdk.slots, spec->motors[i].slot);
  spec->motors.erase(spec->motors.begin() + at);

  const int index = static_cast<int>(i);
  std::erase_if(spec->parallel, [index](const ParallelSpec& pair) {
    return pair.pitch == index || pair.roll == index;
  });
  for (ParallelSpec& pair : spec->parallel) {
    if (pair.pitch > index) --pair.pitch;
    if (pair.roll > index) --pair.roll;
  }
}

}  // namespace understudy::robot
