// Reads the simulation's states from a recording.
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
class StatesReader {
 public:
  struct Span {
    double from = 0, to = 0;  // s, simulated
  };

  explicit StatesReader(const std::filesystem::path& file);

  const McapReader& reader() const { return reader_; }
  const Span& whole() const { return whole_; }

  // Visits the states of that time, ends included, in order until `visit` returns false. Each has
  // `nq` positions.
  void Read(const Span& span, std::size_t nq, const std::function<bool(Truth)>& visit) const;

 private:
  std::uint64_t LogTime(double time) const;

  McapReader reader_;
  std::uint64_t origin_ = 0;  // log time of simulated time 0, ns
  Span whole_;
};

}  // namespace understudy::record
