#include "robot/fault_bank.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nearest_word.h"
#include "base/printed.h"
#include "robot/hand_links.h"

namespace understudy::robot {
namespace {

constexpr double kContact = 0.1;  // s that a loose contact stays as it is; *assumed*
constexpr std::string_view kAll = "all";

// SplitMix64: a number that is spread evenly for inputs that follow each other.
std::uint64_t Mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

std::string Number(double number) { return Printed("%g", number); }

}  // namespace

FaultBank::FaultBank(const RobotSpec& spec, const std::vector<std::string>& links,
                     const std::vector<std::string>& services, int seed,
                     const std::vector<std::string>& further_links)
    : spec_(spec), seed_(static_cast<std::uint64_t>(seed)), buses_(BusesOf(spec)) {
  const auto motors = AllMotors(spec);
  for (std::size_t i = 0; i < motors.size(); ++i) {
    Add(Component::kMotor, i, motors[i]->joint);
    Add(Component::kEncoder, i, motors[i]->joint + ".encoder");
  }
  Add(Component::kImu, 0, "imu");
  if (!spec.imu.secondary_site.empty()) Add(Component::kImu, 1, "secondary_imu");
  for (std::size_t i = 0; i < spec.feet.size(); ++i) {
    Add(Component::kFoot, i, "foot." + spec.feet[i].name);
  }
  Add(Component::kBattery, 0, "battery");
  Add(Component::kRemote, 0, "remote");
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].empty()) Add(Component::kTopic, i, links[i]);
  }
  for (std::size_t i = 0; i < services.size(); ++i) {
    Add(Component::kService, i, "service." + services[i]);
  }
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    if (!buses_[i].name.empty()) Add(Component::kBus, i, "bus." + buses_[i].name);
  }
  Add(Component::kMainboard, 0, "mainboard");
  if (spec.family == WireFamily::kGo) {  // the other family's messages report none of these
    Add(Component::kMcu, 0, "mcu");
    for (std::size_t i = 0; i < spec.fans.size(); ++i) {
      Add(Component::kFan, i, "fan." + spec.fans[i].name);
    }
  }
  // Last: what is drawn goes by the number of a component.
  for (std::size_t i = 0; i < further_links.size(); ++i) {
    Add(Component::kTopic, links.size() + i, further_links[i]);
  }
  if (HasLidar(spec.lidar)) Add(Component::kLidar, 0, "lidar");
  for (std::size_t i = 0; i < spec.cameras.size(); ++i) {
    Add(Component::kCamera, i, "camera." + spec.cameras[i].name);
  }
  for (std::size_t i = 0; i < spec.hands.size(); ++i) {
    Add(Component::kHand, i, "hand." + spec.hands[i].name);
    hand_links_.push_back(HandLinks(spec.hands[i], links));
  }
  faults_.reserve(kMost);
  begun_.reserve(kMost);
  over_.reserve(kMost);
  nothing_.motors.resize(motors.size());
  nothing_.encoders.resize(motors.size());
  nothing_.feet.resize(spec.feet.size());
  nothing_.links.resize(links.size() + further_links.size());
  nothing_.services.resize(services.size());
  nothing_.buses.resize(buses_.size());
  nothing_.fans.resize(spec.fans.size());
  nothing_.cameras.resize(spec.cameras.size());
  nothing_.hands.resize(spec.hands.size());
  effects_ = nothing_;
}

void FaultBank::Add(Component of, std::size_t element, std::string name) {
  places_.push_back({of, element});
  names_.push_back(std::move(name));
}

Result<std::size_t> FaultBank::Find(std::string_view component) const {
  const auto found = std::ranges::find(names_, component);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  const std::string hint = NearestHint(component, names_);
  return Error{"the robot has no '" + std::string(component) + "'" +
               (hint.empty() ? "; expected " + ComponentForms() : hint)};
}

bool FaultBank::Has(std::size_t component, const FaultKind& kind) const {
  return kind.of == places_[component].of && (kind.fits == nullptr || kind.fits(spec_));
}

std::vector<const FaultKind*> FaultBank::KindsOf(std::size_t component) const {
  std::vector<const FaultKind*> kinds;
  for (const FaultKind& row : FaultKinds()) {
    if (Has(component, row)) kinds.push_back(&row);
  }
  return kinds;
}

Result<const FaultKind*> FaultBank::FindKind(std::size_t component, std::string_view kind) const {
  for (const FaultKind& row : FaultKinds()) {
    if (Has(component, row) && row.name == kind) return &row;
  }
  std::string valid;
  for (const FaultKind* row : KindsOf(component)) {
    valid += valid.empty() ? "" : ", ";
    valid += row->name;
  }
  return Error{"'" + std::string(kind) + "' is no fault of a " +
               std::string(NameOf(places_[component].of)) + "; valid: " + valid};
}

Result<Fault> FaultBank::Make(std::string_view component, std::string_view kind, const double* by,
                              const FaultTimes& times, double t) const {
  const auto found = Find(component);
  if (!found) return found.error();
  const auto row = FindKind(*found, kind);
  if (!row) return row.error();
  if (by != nullptr && !(*row)->has_magnitude()) {
    return Error{"by: expected nothing for '" + std::string(kind) + "', found " + Number(*by)};
  }
  if (by != nullptr && !(*by >= (*row)->low && *by <= (*row)->high)) {
    const std::string unit = (*row)->unit.empty() ? "" : " " + std::string((*row)->unit);
    return Error{"by: expected " + Number((*row)->low) + " to " + Number((*row)->high) + unit +
                 " for '" + std::string(kind) + "', found " + Number(*by)};
  }
  return Fault{.kind = *row,
               .component = *found,
               .by = by != nullptr ? *by : (*row)->otherwise,
               .from = t,
               .times = times};
}

void FaultBank::Put(const Fault& fault) {
  const auto same = std::ranges::find_if(faults_, [&](const Fault& one) {
    return one.kind == fault.kind && one.component == fault.component;
  });
  if (same != faults_.end()) {
    *same = fault;
  } else {
    faults_.push_back(fault);
  }
}

Result<Fault> FaultBank::Begin(std::string_view component, std::string_view kind, const double* by,
                               const FaultTimes& times, double t) {
  const auto fault = Make(component, kind, by, times, t);
  if (!fault) return fault.error();
  const bool again = std::ranges::any_of(faults_, [&](const Fault& one) {
    return one.kind == fault->kind && one.component == fault->component;
  });
  if (!again && faults_.size() + planned_.size() >= kMost) {
    return Error{"as many faults as there can be are there"};
  }
  Put(*fault);
  return *fault;
}

Result<> FaultBank::Plan(const PlannedFault& planned) {
  const auto fault = Make(planned.component, planned.fault, planned.by ? &*planned.by : nullptr,
                          planned.times, planned.at);
  if (!fault) return fault.error();
  if (faults_.size() + planned_.size() >= kMost) {
    return Error{"as many faults as there can be are there"};
  }
  // Behind those that come at the same time, which so begin before it.
  const auto place =
      std::ranges::find_if(planned_, [&](const Fault& one) { return one.from <= fault->from; });
  planned_.insert(place, *fault);
  return {};
}

Result<> FaultBank::Clear(std::string_view component) {
  std::size_t gone = places_.size();
  if (component != kAll) {
    const auto found = Find(component);
    if (!found) return found.error();
    gone = *found;
  }
  Drop([&](const Fault& fault) { return component == kAll || fault.component == gone; });
  return {};
}

template <class Predicate>
void FaultBank::Drop(Predicate gone) {
  over_.clear();
  auto kept = faults_.begin();
  for (const Fault& fault : faults_) {
    if (gone(fault)) {
      over_.push_back(fault);
    } else {
      *kept++ = fault;
    }
  }
  faults_.erase(kept, faults_.end());
  if (faults_.empty()) effects_ = nothing_;
}

bool FaultBank::Step(double t) {
  begun_.clear();
  for (; !planned_.empty() && planned_.back().from <= t; planned_.pop_back()) {
    Put(planned_.back());
    begun_.push_back(planned_.back());
  }
  if (faults_.empty()) return false;
  effects_ = nothing_;
  Drop([t](const Fault& fault) {
    return fault.times.lasts > 0 && t >= fault.from + fault.times.lasts;
  });
  for (const Fault& fault : faults_) {
    const double age = std::max(0.0, t - fault.from);
    const auto moment = static_cast<std::uint64_t>(std::llround(age * 1e6));
    const auto contact = static_cast<std::uint64_t>(age / kContact);
    if (Draw(fault, ~contact) >= fault.times.probability) continue;
    const double grown = fault.times.ramp > 0 ? std::min(1.0, age / fault.times.ramp) : 1;
    const Place place = places_[fault.component];
    fault.kind->act({.element = place.element,
                     .by = fault.by,
                     .grown = grown,
                     .age = age,
                     .chance = Draw(fault, moment),
                     .motors = place.of == Component::kBus
                                   ? std::span<const std::size_t>(buses_[place.element].motors)
                                   : std::span<const std::size_t>(),
                     .links = place.of == Component::kHand
                                  ? std::span<const std::size_t>(hand_links_[place.element])
                                  : std::span<const std::size_t>()},
                    &effects_);
  }
  return true;
}

double FaultBank::Draw(const Fault& fault, std::uint64_t moment) const {
  const auto kind = static_cast<std::uint64_t>(fault.kind - FaultKinds().data());
  const std::uint64_t bits = Mixed(Mixed(Mixed(seed_ + kind) + fault.component) + moment);
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

}  // namespace understudy::robot
