// The faults of one robot, and what they do now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "robot/buses.h"
#include "robot/fault.h"
#include "robot/robot_spec.h"

namespace understudy::robot {

// How a fault comes and goes.
struct FaultTimes {
  double lasts = 0;        // s; 0: until it is taken away
  double ramp = 0;         // s in which its magnitude grows from nothing
  double probability = 1;  // that it is there, drawn anew for each tenth of a second
};

// A fault that is to begin by itself, as the configuration has it.
struct PlannedFault {
  std::string component{}, fault{};  // the name of the kind
  std::optional<double> by{};        // nullopt: what is usual of the kind
  double at = 0;                     // simulated s
  FaultTimes times{};
};

// A fault of one component.
struct Fault {
  const FaultKind* kind = nullptr;
  std::size_t component = 0;  // FaultBank::components
  double by = 0;
  double from = 0;  // simulated s
  FaultTimes times;
};

// Keeps faults and adds up their effects. What is drawn depends on seed, component, kind and time
// alone. After the constructor it allocates only to refuse.
class FaultBank {
 public:
  static constexpr std::size_t kMost = 64;

  // `links` are the topics of commands and of states and `further_links` those on which services
  // publish, in the order of Effects::links; `services` are those of Effects::services. What is ""
  // cannot have faults. `spec` must outlive the bank.
  FaultBank(const RobotSpec& spec, const std::vector<std::string>& links,
            const std::vector<std::string>& services, int seed,
            const std::vector<std::string>& further_links = {});

  // Begins a fault at t [s], in place of one of the same kind of the component. `by`: null for what
  // the kind has. The Error names what was expected and the nearest word.
  Result<Fault> Begin(std::string_view component, std::string_view kind, const double* by,
                      const FaultTimes& times, double t);
  // Has a fault begin in the Step of its time, refused as by Begin. Allocates.
  Result<> Plan(const PlannedFault& planned);
  // Takes all faults of a component away, of all components for "all". Those that are planned come
  // all the same.
  Result<> Clear(std::string_view component);

  // Begins the faults that were planned for t [s] or before, brings the effects up to t and drops
  // the faults whose time is over. Times never go back. Returns whether there is or was any.
  bool Step(double t);
  // Returns the faults that the last Step has begun.
  const std::vector<Fault>& begun() const { return begun_; }
  // Returns the faults that the last Clear or Step has taken away.
  const std::vector<Fault>& over() const { return over_; }

  const Effects& effects() const { return effects_; }
  // Whether there is any: while there is none, effects() are those of none.
  bool any() const { return !faults_.empty(); }
  const std::vector<Fault>& faults() const { return faults_; }
  // Returns the name of each component, by its number.
  const std::vector<std::string>& components() const { return names_; }
  // Returns the kinds of fault that a component of this robot can have. Allocates.
  std::vector<const FaultKind*> KindsOf(std::size_t component) const;

 private:
  struct Place {
    Component of;
    std::size_t element;
  };

  void Add(Component of, std::size_t element, std::string name);
  Result<std::size_t> Find(std::string_view component) const;
  // Whether a component of this robot can have a fault of that kind.
  bool Has(std::size_t component, const FaultKind& kind) const;
  Result<const FaultKind*> FindKind(std::size_t component, std::string_view kind) const;
  // Checks what Begin is given.
  Result<Fault> Make(std::string_view component, std::string_view kind, const double* by,
                     const FaultTimes& times, double t) const;
  // In place of the same one, if there is.
  void Put(const Fault& fault);
  // Moves the faults for which gone(fault) holds to over_.
  template <class Predicate>
  void Drop(Predicate gone);
  // Drawn from [0, 1) for a fault and a moment.
  double Draw(const Fault& fault, std::uint64_t moment) const;

  const RobotSpec& spec_;
  std::uint64_t seed_;
  std::vector<MotorBus> buses_;
  std::vector<std::vector<std::size_t>> hand_links_;  // by hand, of its topics
  std::vector<Place> places_;                         // by component, as names_
  std::vector<std::string> names_;
  std::vector<Fault> faults_, begun_, over_;
  std::vector<Fault> planned_;  // the next is the last
  Effects nothing_, effects_;
};

}  // namespace understudy::robot
