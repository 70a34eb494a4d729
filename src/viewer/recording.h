// Reads states and model from a recording, for pictures and films.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "record/mcap_reader.h"
#include "viewer/scene_state.h"
#include "viewer/stage.h"

namespace understudy::viewer {

// What `understudy run --record` wrote: the simulation's truth, and the model beside it. Every
// function throws RecordError for a file that is none or lacks one of them.
class Recording {
 public:
  struct Span {
    double from = 0, to = 0;  // s, simulated
  };

  explicit Recording(const std::filesystem::path& file);

  mjcf::ModelHandle ReadModel() const;

  // The part of it that is asked for, nullopt for its begin and end. Throws SetupError where there
  // is none.
  Span Cut(std::optional<double> from, std::optional<double> to) const;

  // The state at that time, or the last before it, or where it has none the first; nullopt asks for
  // the end. Throws SetupError for a time after its end. `nq`: of the model.
  SceneState At(std::optional<double> time, std::size_t nq) const;

  // Visits the states of that time in order, until `visit` says false.
  void Read(const Span& span, std::size_t nq,
            const std::function<bool(const SceneState&)>& visit) const;

 private:
  std::uint64_t LogTime(double time) const;
  [[noreturn]] void Refuse(double time) const;

  record::McapReader reader_;
  std::uint64_t origin_ = 0;  // log time of simulated time 0, ns
  Span whole_;
};

}  // namespace understudy::viewer
