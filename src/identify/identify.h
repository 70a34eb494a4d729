// Finds a robot's figures from recordings of it (docs/reference/identify.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "identify/fit_told.h"
#include "identify/parameters.h"
#include "identify/replay.h"
#include "identify/samples.h"

namespace understudy::identify {

struct Options {
  std::vector<std::string> parameters{};  // names of FigureKinds(); empty: the usual ones
  double window = 0.2;                    // s
  double hold_out = 0.25;                 // share of the windows, 0 to 0.9; 0: none
};

// What came of a figure.
struct Found {
  Parameter parameter{};
  std::string name{};
  bool told = true;  // false: it stays what it was before
  double value = 0, error = 0;
  double freedom = 0;  // degrees of freedom of the standard error
  std::string why{};   // it is not told

  // Half the width of the interval that holds the truth with a probability: Student's.
  double Bar(double probability) const;
};

struct Correlated {
  std::string first{}, second{};
  double by = 0;
};

// Root mean squares [rad] of the difference of simulated and recorded angles.
struct Fit {
  double before = 0, after = 0;
  std::size_t windows = 0;
};

struct Identification {
  std::vector<Found> found{};
  std::vector<Correlated> correlated{};  // by more than 0.9
  Fit fitted{}, held_out{};
  double window = 0;  // s
};

// Fits by least squares. Windows of `held_out` recordings, or else every so many of the others, are
// not fitted to. `told` needs both of its functions. Throws RecordError where there is too little
// to fit. Returns nullopt if a signal asked to stop.
std::optional<Identification> Identify(const Replay& replay, const Basis& basis,
                                       std::span<const Samples> recordings,
                                       std::span<const Samples> held_out, const Options& options,
                                       const FitTold& told);

// For a terminal; for programs; and for --config.
std::string ResultText(const Identification& result, std::span<const Samples> recordings);
std::string ResultJson(const Identification& result, std::span<const Samples> recordings);
std::string ResultYaml(const Identification& result, const Basis& basis,
                       std::span<const Samples> recordings);

}  // namespace understudy::identify
