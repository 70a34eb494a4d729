// The interface of behaviours, which control the motors while a motion service is in a state.
#pragma once

namespace understudy::motion {

// A behaviour is active from its Begin until it is over or another one begins. Each has its own
// Begin, which takes the last reading and further arguments. Allocates only in the constructor.
template <class Sensed, class Command>
class BehaviourOf {
 public:
  virtual ~BehaviourOf() = default;

  // Makes one step of dt [s]. `command` has the result of the previous step, of any behaviour.
  virtual void Step(const Sensed& sensed, double dt, Command* command) = 0;

  virtual bool over() const = 0;
};

}  // namespace understudy::motion
