// Reads states and model from a recording, for pictures and films.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "record/truth_reader.h"
#include "viewer/scene_state.h"
#include "viewer/screen_text.h"
#include "viewer/stage.h"

namespace understudy::viewer {

// A recording of `understudy run --record`: the simulation's truth and the model. All functions
// throw RecordError for another file, or one without these.
class RecordedStates {
 public:
  using Span = record::TruthReader::Span;

  explicit RecordedStates(const std::filesystem::path& file) : truth_(file) {}

  mjcf::ModelHandle ReadModel() const;

  // Returns the name of its robot in a world of several; else "".
  std::string robot() const;

  // Returns the requested part; nullopt stands for the beginning and the end. Throws SetupError if
  // it is empty.
  Span Cut(std::optional<double> from, std::optional<double> to) const;

  // Returns the state at that time or the last one before, else the first; nullopt means the end.
  // Throws SetupError for a time after the end. `nq` is that of the model.
  SceneState At(std::optional<double> time, std::size_t nq) const;

  // Visits the states of that time in order until `visit` returns false, and between them passes
  // the events that pictures show (record::IsForPictures), also those of the `before` s before.
  using Visit = std::function<bool(const SceneState&)>;
  using Tell = std::function<void(FilmEvent)>;
  void Read(const Span& span, std::size_t nq, const Visit& visit, const Tell& tell = {},
            double before = 0) const;

 private:
  [[noreturn]] void Refuse(double time) const;

  record::TruthReader truth_;
};

}  // namespace understudy::viewer
