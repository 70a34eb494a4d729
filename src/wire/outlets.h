// All that a robot publishes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bus/participant.h"
#include "wire/outlet.h"

namespace understudy::wire {

// The outlets of one robot in one list: those of its states, then those of its services
// (PublishedTopics). For the thread of the tick.
class Outlets {
 public:
  // `participant` must outlive it; `timestep` [s] is that of the physics.
  Outlets(const bus::Participant& participant, double timestep)
      : participant_(participant), timestep_(timestep) {}
  Outlets(const Outlets&) = delete;
  Outlets& operator=(const Outlets&) = delete;

  // Adds an outlet, which lives as long as this. Throws BusError if Cyclone refuses or if Msg is
  // not the topic's type.
  template <typename Msg>
  Outlet<Msg>* Open(const RobotTopic& topic) {
    auto outlet = std::make_unique<Outlet<Msg>>(participant_, DescriptorOf(topic), topic, timestep_,
                                                outlets_.size(), &tick_);
    Outlet<Msg>* const opened = outlet.get();
    outlets_.push_back(std::move(outlet));
    return opened;
  }

  // Begins the tick at t [s], which never goes back, and sends what was late and has arrived.
  // `faults` are those of the outlets in their order, valid until the next call; empty: none.
  void BeginTick(double t, std::span<const robot::LinkEffects> faults);
  // Drops all that is under way.
  void Clear();

  // Returns how many messages Cyclone has refused so far.
  std::uint64_t failures() const { return tick_.failures; }
  std::size_t size() const { return outlets_.size(); }
  const OutletCore& operator[](std::size_t i) const { return *outlets_[i]; }

 private:
  // Throws BusError if the type is none of the vendor's.
  static const dds_topic_descriptor& DescriptorOf(const RobotTopic& topic);

  const bus::Participant& participant_;
  double timestep_;
  OutletTick tick_;
  std::vector<std::unique_ptr<OutletCore>> outlets_;
};

}  // namespace understudy::wire
