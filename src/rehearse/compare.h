// Compares two recordings of a robot, such as a rehearsal and the performance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/plot.h"
#include "rehearse/recorded.h"

namespace understudy::rehearse {

// How far the values of two recordings are apart at the same time; nullopt where one has none.
struct Apart {
  std::string name{};  // of the quantity
  std::string unit{};
  std::optional<double> rms{}, most{};
  std::optional<double> rms_first{}, rms_second{};  // of the values themselves
};

// How a motor follows its commands.
struct Following {
  std::optional<double> error{};  // rad, rms of command and angle
  std::optional<double> lag{};    // s by which the angle lies behind the command
};

struct MotorComparison {
  int slot = 0;
  std::string joint{};  // the slot's number if neither recording has names
  Apart q{}, dq{}, tau{};
  Following first{}, second{};
  record::TracePoints q_first{}, q_second{};  // s of the first recording, rad
};

struct Differences {
  std::string first{}, second{};  // files
  std::string robot{};
  double shift = 0;         // s: the second's time plus this is the first's
  double likeness = 0;      // of the movements at that shift: 1 the same, 0 none in common
  bool aligned = false;     // by their movements; else from their starts, or as told
  double from = 0, to = 0;  // s of the first, in which both say something
  double step = 0;          // s
  std::vector<MotorComparison> motors{};
  std::vector<Apart> rest{};  // inertial unit and battery
};

// Shifts the second in time so that the joints' angles are most alike, or by `shift` [s], and
// compares what both say then. The likeness is the sum over joints of the covariance of their
// angles over the root of the product of the sums of variances. Throws RecordError for recordings
// of different robots, and where less than a second is left in common.
Differences Compare(const record::RecordingReader& first, const record::RecordingReader& second,
                    std::optional<double> shift);

// For a terminal, for programs (docs/rehearsing.md), and as one page that needs nothing else.
std::string CompareText(const Differences& comparison);
std::string CompareJson(const Differences& comparison);
std::string CompareHtml(const Differences& comparison);

}  // namespace understudy::rehearse
