#include "record/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace understudy::record {
namespace {

constexpr std::size_t kMotorsUnasked = 6;

// Returns the name without its side: "FR_calf" and "RL_calf" are of the kind "calf".
std::string KindOf(const std::string& motor) {
  for (const std::string_view side : {"FR_", "FL_", "RR_", "RL_", "left_", "right_"}) {
    if (motor.starts_with(side)) return motor.substr(side.size());
  }
  return motor;
}

double Range(const TracePoints& points) {
  if (points.empty()) return 0;
  const auto [least, most] =
      std::ranges::minmax_element(points, {}, &TracePoints::value_type::second);
  return most->second - least->second;
}

std::string LabelOf(const RunColumn& column) { return column.quantity + " [" + column.unit + "]"; }

// Collects everything for a page in one pass over the recording.
class PageMaker final : public RunReader {
 public:
  PageMaker(const RecordingReader& reader, const PlotOptions& options)
      : RunReader(reader, options.what), options_(options), traces_(columns().size()) {
    page_.from = from();
    page_.to = to();
  }

  PlotPage Make() {
    Read();
    AddBase();
    AddMotors();
    AddSignals();
    if (page_.panels.empty()) {
      throw RecordError(reader().path().string() + ": has no data of a robot that can be drawn");
    }
    page_.title = reader().path().filename().string();
    if (!About("robot").empty()) page_.title = About("robot") + ", " + page_.title;
    if (!About("started").empty()) page_.title += ", " + About("started");
    page_.width = options_.width;
    page_.height =
        options_.height > 0 ? options_.height : 150 + 230 * static_cast<int>(page_.panels.size());
    return std::move(page_);
  }

 private:
  void Note(double at, double value, std::size_t column) override {
    traces_[column].Add(at, value, page_.from, page_.to);
  }

  // Events of one kind that follow each other closely become one mark.
  void NoteEvent(double at, const RecordedEvent& event) override {
    if (!IsForPictures(event.kind)) return;
    const double close = 0.02 * (page_.to - page_.from);
    const auto [last, is_new] = last_of_.try_emplace(event.kind, at, page_.marks.size());
    const bool follows = !is_new && at - last->second.first < close;
    last->second.first = at;
    if (follows) {
      ++page_.marks[last->second.second].times;
      return;
    }
    last->second.second = page_.marks.size();
    page_.marks.push_back({.at = at, .kind = event.kind, .text = event.text});
  }

  PlotLine Line(std::string name, std::size_t color, std::size_t column,
                bool dashed = false) const {
    return {.name = std::move(name),
            .color = static_cast<int>(color),
            .dashed = dashed,
            .points = Thinned(traces_[column].points(), page_.from, page_.to)};
  }

  void AddBase() {
    if (traces_[0].points().empty()) return;
    page_.panels.push_back({.label = "height [m]", .lines = {Line("base", 0, 0)}});
    page_.panels.push_back({.label = "attitude [°]",
                            .lines = {Line("roll", 0, 1), Line("pitch", 1, 2), Line("yaw", 2, 3)}});
  }

  // Unless told, of each kind of joint the one that moves most, and of the kinds those that move
  // most.
  std::set<std::size_t> Chosen() const {
    std::map<std::string, std::pair<double, std::size_t>> most;  // by kind: range, motor
    std::set<std::size_t> chosen;
    for (std::size_t i = kBaseColumns; i < columns().size(); ++i) {
      const RunColumn& line = columns()[i];
      if (line.kind != RunColumn::Kind::kMotor) continue;
      if (!options_.what.motors.empty()) chosen.insert(line.motor);
      if (line.field != 0 || line.commanded) continue;
      const double range = Range(traces_[i].points());
      const auto [kind, is_new] =
          most.try_emplace(KindOf(motors()[line.motor].name), range, line.motor);
      if (range > kind->second.first) kind->second = {range, line.motor};
    }
    if (!chosen.empty()) return chosen;
    std::vector<std::pair<double, std::size_t>> moves;
    for (const auto& [kind, best] : most) moves.push_back(best);
    std::ranges::sort(moves, std::greater<>());
    for (std::size_t i = 0; i < std::min(moves.size(), kMotorsUnasked); ++i) {
      chosen.insert(moves[i].second);
    }
    return chosen;
  }

  void AddMotors() {
    const std::set<std::size_t> chosen = Chosen();
    for (const std::size_t motor : chosen) page_.slots.push_back(motors()[motor].slot);
    for (std::size_t field = 0; field < fields().size(); ++field) {
      PlotPanel panel;
      for (const bool commanded : {true, false}) {
        std::size_t color = 0;
        for (const std::size_t motor : chosen) {
          const auto line = std::ranges::find_if(columns(), [&](const RunColumn& one) {
            return one.kind == RunColumn::Kind::kMotor && one.field == field &&
                   one.motor == motor && one.commanded == commanded;
          });
          const std::size_t its_color = color++;
          if (line == columns().end()) continue;
          const auto column = static_cast<std::size_t>(line - columns().begin());
          if (traces_[column].points().empty()) continue;
          panel.label = LabelOf(*line);
          panel.lines.push_back(
              Line(commanded ? "" : motors()[motor].name, its_color, column, commanded));
        }
      }
      if (!panel.lines.empty()) page_.panels.push_back(std::move(panel));
    }
  }

  void AddSignals() {
    for (std::size_t i = kBaseColumns; i < columns().size(); ++i) {
      if (columns()[i].kind != RunColumn::Kind::kSignal) continue;
      const std::string& signal = columns()[i].name;
      const std::string path = signal.substr(signal.find(':') + 1);
      if (traces_[i].points().empty()) {
        throw RecordError("--signals: nothing says " + signal + " from " +
                          std::to_string(page_.from) + " to " + std::to_string(page_.to) + " s");
      }
      // A short label, which fits beside its axis.
      page_.panels.push_back(
          {.label = path.substr(path.rfind('.') + 1), .lines = {Line(path, 0, i)}});
    }
  }

  const PlotOptions& options_;
  PlotPage page_;
  std::vector<Trace> traces_;  // by column
  // The last event of each kind: its time and its mark.
  std::map<std::string, std::pair<double, std::size_t>> last_of_;
};

}  // namespace

PlotPage MakePage(const RecordingReader& reader, const PlotOptions& options) {
  return PageMaker(reader, options).Make();
}

PlotPage MakePage(const RecordingReader& first, const RecordingReader& second, double shift,
                  const PlotOptions& options) {
  PlotPage page = MakePage(first, options);
  PlotOptions others = options;
  others.what.motors.clear();
  for (const int slot : page.slots) others.what.motors.push_back(std::to_string(slot));
  others.what.from = std::max(0.0, page.from - shift);
  others.what.to = page.to - shift;
  if (!(others.what.to > others.what.from)) {
    throw RecordError(second.path().string() + ": --shift " + std::to_string(shift) +
                      " leaves nothing in common with " + first.path().string());
  }
  const PlotPage other = MakePage(second, others);
  page.title += "; dashed: " + other.title;
  page.dashed = second.path().filename().string();
  for (PlotPanel& panel : page.panels) {
    std::erase_if(panel.lines, &PlotLine::dashed);  // what was commanded
  }
  for (const PlotPanel& theirs : other.panels) {
    const auto panel = std::ranges::find(page.panels, theirs.label, &PlotPanel::label);
    if (panel == page.panels.end()) continue;
    for (PlotLine line : theirs.lines) {
      if (line.dashed) continue;
      line.dashed = true;
      line.name.clear();
      for (auto& [at, value] : line.points) at += shift;
      panel->lines.push_back(std::move(line));
    }
  }
  for (PlotMark mark : other.marks) {
    mark.at += shift;
    mark.text = page.dashed + ": " + mark.text;
    page.marks.push_back(std::move(mark));
  }
  std::ranges::stable_sort(page.marks, {}, &PlotMark::at);
  return page;
}

TracePoints Thinned(const TracePoints& all, double from, double to) {
  if (all.size() <= 2 * kTraceColumns) return all;
  TracePoints thin;
  const double width = (to - from) / static_cast<double>(kTraceColumns);
  for (std::size_t begin = 0; begin < all.size();) {
    const double column = std::floor((all[begin].first - from) / width);
    std::size_t end = begin, least = begin, most = begin;
    for (; end < all.size() && std::floor((all[end].first - from) / width) == column; ++end) {
      if (all[end].second < all[least].second) least = end;
      if (all[end].second > all[most].second) most = end;
    }
    thin.push_back(all[std::min(least, most)]);
    if (least != most) thin.push_back(all[std::max(least, most)]);
    begin = std::max(end, begin + 1);
  }
  return thin;
}

void Trace::Add(double at, double value, double from, double to) {
  if (!std::isfinite(value)) return;
  points_.emplace_back(at, value);
  if (points_.size() < full_) return;
  points_ = Thinned(points_, from, to);
  full_ = std::max(kFull, 2 * points_.size());  // times that go back may keep it long
}

}  // namespace understudy::record
