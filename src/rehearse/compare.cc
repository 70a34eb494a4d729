#include "rehearse/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <span>

#include "base/errors.h"

namespace understudy::rehearse {
namespace {

// *Assumed*, all of them: steps of time, the most of them, and of those by which shifts are looked
// for; the least time in common; from where on an angle moves; the longest lag.
constexpr double kStep = 0.002;         // s, LowState's period
constexpr double kMostSteps = 100'000;  // of a recording
constexpr double kCoarse = 0.02;        // s between shifts at first
constexpr double kMostCoarse = 3000;    // steps of a recording then
constexpr double kLeastCommon = 1;      // s
constexpr double kLeastShare = 0.3;     // of the shorter
constexpr double kMoves = 0.02;         // rad, standard deviation of a joint
constexpr double kLongestLag = 0.3;     // s

using Values = std::span<const float>;

// A step of the first and the same instant of the second.
struct Common {
  std::ptrdiff_t first = 0, second = 0, count = 0;

  Common(std::size_t of_first, std::size_t of_second, std::ptrdiff_t shift) {
    first = std::max<std::ptrdiff_t>(0, shift);
    second = first - shift;
    count = std::min(static_cast<std::ptrdiff_t>(of_first) - first,
                     static_cast<std::ptrdiff_t>(of_second) - second);
    count = std::max<std::ptrdiff_t>(0, count);
  }
  Values Of(Values values, std::ptrdiff_t begin) const {
    return values.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count));
  }
};

// Sums over the instants at which both are known.
struct Moments {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0, dd = 0, most = 0;

  Moments(Values first, Values second) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      const double x = first[i], y = second[i];
      if (std::isnan(x) || std::isnan(y)) continue;
      ++n;
      a += x;
      b += y;
      aa += x * x;
      bb += y * y;
      ab += x * y;
      dd += (x - y) * (x - y);
      most = std::max(most, std::abs(x - y));
    }
  }
  double covariance() const { return n > 0 ? ab / n - a / n * b / n : 0; }
  double variance_a() const { return n > 0 ? std::max(0.0, aa / n - a / n * a / n) : 0; }
  double variance_b() const { return n > 0 ? std::max(0.0, bb / n - b / n * b / n) : 0; }
};

// The angles of the joints that both have.
struct Pair {
  const Series* first;
  const Series* second;
};

std::vector<Pair> PairsOf(const Recorded& first, const Recorded& second,
                          std::string_view quantity) {
  std::vector<Pair> pairs;
  for (const Series& one : first.series) {
    if (one.quantity->name != quantity) continue;
    if (const Series* other = second.Find(quantity, one.slot)) pairs.push_back({&one, other});
  }
  return pairs;
}

// Every `by`th value.
std::vector<float> Thinned(const std::vector<float>& values, std::size_t by) {
  std::vector<float> thinned;
  for (std::size_t i = 0; i < values.size(); i += by) thinned.push_back(values[i]);
  return thinned;
}

double Likeness(const std::vector<std::pair<Values, Values>>& pairs, std::ptrdiff_t shift) {
  double covariance = 0, variance_a = 0, variance_b = 0;
  for (const auto& [a, b] : pairs) {
    const Common common(a.size(), b.size(), shift);
    const Moments moments(common.Of(a, common.first), common.Of(b, common.second));
    covariance += moments.covariance();
    variance_a += moments.variance_a();
    variance_b += moments.variance_b();
  }
  const double still = kMoves * kMoves;
  if (variance_a < still || variance_b < still) return 0;
  return covariance / std::sqrt(variance_a * variance_b);
}

// The shift from `low` to `high` with the greatest likeness.
struct Best {
  std::ptrdiff_t shift = 0;
  double likeness = -1;

  Best(const std::vector<std::pair<Values, Values>>& pairs, std::ptrdiff_t low,
       std::ptrdiff_t high) {
    for (std::ptrdiff_t one = low; one <= high; ++one) {
      const double found = Likeness(pairs, one);
      // Of equals the one that shifts least.
      const bool nearer = found == likeness && std::abs(one) < std::abs(shift);
      if (found > likeness || nearer) {
        shift = one;
        likeness = found;
      }
    }
  }
};

Best Align(const std::vector<Pair>& angles, double step) {
  std::size_t length = 0, shorter = ~std::size_t{0};
  for (const auto& [a, b] : angles) {
    length = std::max({length, a->values.size(), b->values.size()});
    shorter = std::min({shorter, a->values.size(), b->values.size()});
  }
  // Coarsely over all that leaves enough in common, then around the best.
  const auto by = static_cast<std::size_t>(
      std::max(std::ceil(kCoarse / step), std::ceil(static_cast<double>(length) / kMostCoarse)));
  std::vector<std::vector<float>> kept;
  kept.reserve(2 * angles.size());
  std::vector<std::pair<Values, Values>> coarse, fine;
  for (const auto& [a, b] : angles) {
    kept.push_back(Thinned(a->values, by));
    kept.push_back(Thinned(b->values, by));
    coarse.emplace_back(kept[kept.size() - 2], kept.back());
    fine.emplace_back(a->values, b->values);
  }
  const auto least = static_cast<std::ptrdiff_t>(kLeastShare * static_cast<double>(shorter) /
                                                 static_cast<double>(by));
  const auto of_first = static_cast<std::ptrdiff_t>(coarse.front().first.size());
  const auto of_second = static_cast<std::ptrdiff_t>(coarse.front().second.size());
  const Best rough(coarse, least - of_second, of_first - least);
  const auto around = rough.shift * static_cast<std::ptrdiff_t>(by);
  const auto reach = static_cast<std::ptrdiff_t>(by);
  return {fine, around - reach, around + reach};
}

Apart ApartOf(const Quantity& quantity, const Series* first, const Series* second,
              std::ptrdiff_t shift) {
  Apart apart{.name = std::string(quantity.name), .unit = std::string(quantity.unit)};
  if (first == nullptr || second == nullptr) return apart;
  const Common common(first->values.size(), second->values.size(), shift);
  const Moments moments(common.Of(first->values, common.first),
                        common.Of(second->values, common.second));
  if (moments.n == 0) return apart;
  apart.rms = std::sqrt(moments.dd / moments.n);
  apart.most = moments.most;
  apart.rms_first = std::sqrt(moments.aa / moments.n);
  apart.rms_second = std::sqrt(moments.bb / moments.n);
  return apart;
}

Following FollowingOf(const Recorded& recorded, int slot) {
  const Series* command = recorded.Find("command", slot);
  const Series* q = recorded.Find("q", slot);
  if (command == nullptr || q == nullptr) return {};
  const Moments together(command->values, q->values);
  if (together.n == 0) return {};
  Following following{.error = std::sqrt(together.dd / together.n)};
  if (together.variance_a() < kMoves * kMoves) return following;
  // The angle at t is most like the command at t - lag.
  double best = -1;
  const auto longest = static_cast<std::ptrdiff_t>(kLongestLag / recorded.step);
  for (std::ptrdiff_t lag = 0; lag <= longest; ++lag) {
    const Common common(q->values.size(), command->values.size(), lag);
    const Moments moments(common.Of(q->values, common.first),
                          common.Of(command->values, common.second));
    const double variance = moments.variance_a() * moments.variance_b();
    const double likeness = variance > 0 ? moments.covariance() / std::sqrt(variance) : 0;
    if (likeness > best) {
      best = likeness;
      following.lag = static_cast<double>(lag) * recorded.step;
    }
  }
  return following;
}

record::TracePoints PointsOf(const Series& series, double step, double shift, double from,
                             double to) {
  record::TracePoints points;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const double at = static_cast<double>(i) * step + shift;
    if (at >= from && at <= to && !std::isnan(series.values[i])) {
      points.emplace_back(at, series.values[i]);
    }
  }
  return record::Thinned(points, from, to);
}

void CheckTheyAreOfOneRobot(const Recorded& first, const Recorded& second) {
  const auto who = [](const Recorded& one) {
    return one.robot.empty() ? std::string(one.hg ? "hg" : "go") : one.robot;
  };
  const bool named = !first.robot.empty() && !second.robot.empty();
  if (first.hg == second.hg && (!named || first.robot == second.robot)) return;
  throw RecordError(first.file + " is of " + who(first) + ", " + second.file + " of " +
                    who(second) + ": expected recordings of one robot");
}

}  // namespace

Differences Compare(const record::RecordingReader& first_reader,
                    const record::RecordingReader& second_reader, std::optional<double> shift) {
  const double longer = std::max(SecondsOfStates(first_reader), SecondsOfStates(second_reader));
  const double step = std::max(kStep, longer / kMostSteps);
  Recorded first = ReadRecorded(first_reader, step);
  Recorded second = ReadRecorded(second_reader, step);
  if (first.file == second.file) {
    first.file = first_reader.path().string();
    second.file = second_reader.path().string();
  }
  CheckTheyAreOfOneRobot(first, second);
  const std::vector<Pair> angles = PairsOf(first, second, "q");
  if (angles.empty()) {
    throw RecordError(first.file + " and " + second.file + " have no motor in common");
  }

  std::ptrdiff_t steps = 0;
  Differences comparison{.first = first.file,
                         .second = second.file,
                         .robot = first.robot.empty() ? second.robot : first.robot,
                         .step = step};
  std::vector<std::pair<Values, Values>> all;
  for (const auto& [a, b] : angles) all.emplace_back(a->values, b->values);
  if (shift) {
    steps = static_cast<std::ptrdiff_t>(std::llround(*shift / step));
  } else if (const Best best = Align(angles, step); best.likeness > 0) {
    steps = best.shift;
    comparison.aligned = true;
  }
  comparison.likeness = std::max(0.0, Likeness(all, steps));
  comparison.shift = static_cast<double>(steps) * step;
  const Common common(all.front().first.size(), all.front().second.size(), steps);
  comparison.from = static_cast<double>(common.first) * step;
  comparison.to = comparison.from + static_cast<double>(common.count) * step;
  if (comparison.to - comparison.from < kLeastCommon) {
    throw RecordError(first.file + " and " + second.file +
                      " have less than a second in common at that shift");
  }

  const auto& joints = first.joints.empty() ? second.joints : first.joints;
  for (const auto& [a, b] : angles) {
    const auto name = joints.find(a->slot);
    if (!joints.empty() && name == joints.end()) continue;
    const Moments moments(a->values, a->values);
    if (joints.empty() && moments.aa == 0) continue;  // a slot without a motor
    MotorComparison motor{.slot = a->slot,
                          .joint = joints.empty() ? std::to_string(a->slot) : name->second};
    for (const Quantity& quantity : Quantities()) {
      if (!quantity.of_motor) continue;
      const Apart apart = ApartOf(quantity, first.Find(quantity.name, a->slot),
                                  second.Find(quantity.name, a->slot), steps);
      if (quantity.name == "q") motor.q = apart;
      if (quantity.name == "dq") motor.dq = apart;
      if (quantity.name == "tau") motor.tau = apart;
    }
    motor.first = FollowingOf(first, a->slot);
    motor.second = FollowingOf(second, a->slot);
    motor.q_first = PointsOf(*a, step, 0, comparison.from, comparison.to);
    motor.q_second = PointsOf(*b, step, comparison.shift, comparison.from, comparison.to);
    comparison.motors.push_back(std::move(motor));
  }
  for (const Quantity& quantity : Quantities()) {
    if (quantity.of_motor) continue;
    const Apart apart =
        ApartOf(quantity, first.Find(quantity.name), second.Find(quantity.name), steps);
    if (apart.rms) comparison.rest.push_back(apart);
  }
  return comparison;
}

}  // namespace understudy::rehearse
