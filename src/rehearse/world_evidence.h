// Joins the evidence of the robots of a world.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/evidence.h"

namespace understudy::rehearse {

// Takes the messages of a recording of each robot, in the order of each file, and gives one sample
// for each instant at which a robot has one. How the files' messages mix makes no difference.
class WorldEvidence {
 public:
  // `signals` and `give` as Evidence has them; `robots` are the names of several robots, empty for
  // one.
  WorldEvidence(std::vector<Signal> signals, std::vector<std::string> robots, Evidence::Give give);

  // Before the first message of a robot, by its number, and for each. The robots may have a thread
  // each.
  void Begin(std::size_t robot, std::uint64_t start);
  void Take(std::size_t robot, const record::McapChannel& channel, std::string_view ros_type,
            const record::McapMessage& message);
  // Gives the last samples; all other threads are done.
  void Finish();

  // As Evidence has it.
  std::string WhyUnknown(std::size_t signal) const;
  // All events in the order of their times; those of the world once. Of several robots the text of
  // an event begins with its robot's name.
  std::vector<Evidence::Told> events() const;

 private:
  struct Sample {
    judge::Time at;
    std::vector<double> values;
  };

  void Add(std::size_t robot, judge::Time at, std::span<const double> values);
  bool GiveNext(bool all);

  std::vector<Signal> signals_;
  std::vector<std::string> robots_;
  Evidence::Give give_;
  std::mutex mutex_;                              // of what follows
  std::vector<std::unique_ptr<Evidence>> parts_;  // by robot, from Begin on
  std::vector<std::deque<Sample>> waiting_;       // by robot, until the others get that far
  std::vector<double> values_;
};

}  // namespace understudy::rehearse
