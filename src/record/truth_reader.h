// Reads the simulation's truth from a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "record/mcap_reader.h"
#include "record/truth.h"

namespace understudy::record {

// The truth in a recording of `understudy run --record`. All functions throw RecordError for
// another file, or one without it.
class TruthReader {
 public:
  struct Span {
    double from = 0, to = 0;  // s, simulated
  };

  static constexpr double kLookBack = 1;  // s in which there is a state for sure

  explicit TruthReader(const std::filesystem::path& file);

  const McapReader& reader() const { return reader_; }
  const Span& whole() const { return whole_; }

  // Visits the states of that time, ends included, in order until `visit` returns false, and
  // between them passes the events, also those of the `before` s before. Each state has `nq`
  // positions.
  using Visit = std::function<bool(Truth)>;
  using Tell = std::function<void(RecordedEvent)>;
  void Read(const Span& span, std::size_t nq, const Visit& visit, const Tell& tell = {},
            double before = 0) const;

  // Returns the log time of a simulated time [s], 0 for one before the start.
  std::uint64_t LogTime(double time) const;

 private:
  McapReader reader_;
  std::uint64_t origin_ = 0;  // log time of simulated time 0, ns
  Span whole_;
};

}  // namespace understudy::record
