// What leads a robot while its motion service is in a state.
#pragma once

namespace understudy::motion {

// Leads from its beginning until it is over or another one begins. Each has a Begin of its own,
// which takes what was sensed last and what it needs besides. Allocates nothing after its
// constructor.
template <class Sensed, class Command>
class BehaviourOf {
 public:
  virtual ~BehaviourOf() = default;

  // One step of dt [s]. `command` is what the last step of any behaviour said.
  virtual void Step(const Sensed& sensed, double dt, Command* command) = 0;

  virtual bool over() const = 0;
};

}  // namespace understudy::motion
