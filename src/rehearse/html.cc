// The report of a rehearsal as one page.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "record/svg_plot.h"
#include "rehearse/outputs.h"
#include "version.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;
using judge::Verdict;

std::string TimeText(double seconds) { return Printed("%.3f s", seconds); }

// The comparisons of an expectation with one signal, in one unit.
struct Drawn {
  std::size_t signal = 0;
  std::string unit{};
  double scale = 1;
  std::vector<double> limits{};
};

// What can be drawn of an expectation: numbers, not words and events.
std::vector<Drawn> DrawnOf(const Expectation& expectation, const Expectations& expectations) {
  std::vector<Drawn> all;
  for (const std::vector<LeafText>* leaves : {&expectation.leaves, &expectation.until_leaves}) {
    for (const LeafText& leaf : *leaves) {
      const Signal& signal = expectations.signals[leaf.signal];
      const bool is_word = leaf.leaf.compare == judge::Compare::kEqual && leaf.leaf.value > 1e15;
      if (leaf.leaf.compare == judge::Compare::kTrue || is_word) continue;
      const auto known = std::ranges::find(all, leaf.signal, &Drawn::signal);
      const bool first = known == all.end();
      Drawn& drawn = first ? all.emplace_back() : *known;
      if (first) {
        drawn = {.signal = leaf.signal,
                 .unit = leaf.unit.empty() ? signal.unit : leaf.unit,
                 .scale = leaf.leaf.scale};
      }
      const double to_drawn = drawn.scale / leaf.leaf.scale;
      drawn.limits.push_back((leaf.leaf.value - leaf.leaf.tolerance) * to_drawn);
      if (leaf.leaf.tolerance > 0) {
        drawn.limits.push_back((leaf.leaf.value + leaf.leaf.tolerance) * to_drawn);
      }
    }
  }
  return all;
}

record::TracePoints Scaled(record::TracePoints points, double scale) {
  for (auto& [at, value] : points) value *= scale;
  return points;
}

std::string Figure(const record::SvgPlot& plot, const std::string& caption) {
  return "<figure>" + DrawSvg(plot) + "<figcaption>" + Escaped(caption) + "</figcaption></figure>";
}

// What happened; of the script what it asked for.
std::string TextOf(const Evidence::Told& told, const Occasion& occasion) {
  if (told.event.kind != "script") return told.event.text;
  const auto detail = nlohmann::json::parse(told.event.detail, nullptr, false);
  if (!detail.is_object() || !detail.contains("event") || !detail["event"].is_number_unsigned()) {
    return told.event.text;
  }
  const auto number = detail["event"].get<std::size_t>();
  if (number >= occasion.script.size()) return told.event.text;
  return occasion.script[number] + " (" + told.event.text + ")";
}

std::string PlotsOf(std::size_t index, const Occasion& occasion, const Expectations& expectations,
                    const Judged& judged) {
  const Expectation& expectation = expectations.list[index];
  const Ruling& ruling = judged.rulings[index];
  const Verdict& verdict = ruling.verdict;
  std::vector<std::pair<double, std::string>> events;
  for (const Evidence::Told& told : judged.events) {
    events.emplace_back(SecondsOf(told.at), TextOf(told, occasion));
  }
  std::string html;
  for (const Drawn& drawn : DrawnOf(expectation, expectations)) {
    const std::string& name = expectations.signals[drawn.signal].name;
    record::SvgPlot whole{
        .label = name + (drawn.unit.empty() ? "" : " [" + drawn.unit + "]"),
        .to = std::max(judged.end, 1e-3),
        .lines = {{.kind = "signal", .points = Scaled(judged.whole[drawn.signal], drawn.scale)}},
        .limits = drawn.limits,
        .events = events,
        .width = 600};
    if (whole.lines[0].points.empty()) continue;
    if (verdict.begin && verdict.end) {
      whole.window = std::pair(SecondsOf(*verdict.begin), SecondsOf(*verdict.end));
    }
    if (ruling.why.empty()) whole.at = SecondsOf(verdict.worth.at);
    html += Figure(
        whole,
        "The whole run. Shaded: the window; dashed: what it is compared with; marks: events");
    const auto place = std::ranges::find(expectation.signals, drawn.signal);
    const Closeup& closeup =
        judged.closeups[index][static_cast<std::size_t>(place - expectation.signals.begin())];
    if (!whole.at || closeup.points.empty() || closeup.to <= closeup.from) continue;
    record::SvgPlot near = whole;
    near.from = closeup.from;
    near.to = closeup.to;
    near.lines[0].points = Scaled(closeup.points, drawn.scale);
    near.width = 420;
    html += Figure(near, "Around the instant that decided, " + TimeText(*whole.at));
  }
  return html.empty() ? "" : "<div class=\"plots\">" + html + "</div>";
}

std::string ClaimHtml(std::size_t index, const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged) {
  const Expectation& expectation = expectations.list[index];
  const Ruling& ruling = judged.rulings[index];
  const std::string margin = MarginText(expectation, ruling.verdict);
  return "<section class=\"claim " + HtmlClass(ruling.verdict.outcome) + "\" id=\"e" +
         std::to_string(index) + "\"><h3>" + Badge(ruling.verdict.outcome) + " " +
         Escaped(expectation.name) + "</h3>" +
         (expectation.says.empty() ? "" : "<p>" + Escaped(expectation.says) + "</p>") +
         "<p><code>" + Escaped(expectation.asks) + "</code> <span class=\"dim\">" +
         Escaped(expectation.where) + "</span></p><p>" + Escaped(Explain(expectation, ruling)) +
         (margin.empty() ? "" : "; margin <b>" + Escaped(margin) + "</b>") + "</p>" +
         PlotsOf(index, occasion, expectations, judged) + "</section>\n";
}

std::string Summary(const Expectations& expectations, const Judged& judged) {
  std::string html =
      "<table><tr><th></th><th>Expectation</th><th>What decided</th><th "
      "class=\"number\">Margin</th></tr>\n";
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const Expectation& one = expectations.list[i];
    const Ruling& ruling = judged.rulings[i];
    html += "<tr><td>" + Badge(ruling.verdict.outcome) + "</td><td><a href=\"#e" +
            std::to_string(i) + "\">" + Escaped(one.name) + "</a></td><td>" +
            Escaped(Explain(one, ruling)) + "</td><td class=\"number\">" +
            Escaped(MarginText(one, ruling.verdict)) + "</td></tr>\n";
  }
  html += "</table>\n";
  if (expectations.robots.empty()) return html;
  html += "<table><tr><th></th><th>Robot</th></tr>\n";
  for (std::size_t i = 0; i < expectations.robots.size(); ++i) {
    const auto outcome = OutcomeOf(i, expectations, judged);
    html += "<tr><td>" + (outcome ? Badge(*outcome) : "") + "</td><td>" +
            Escaped(expectations.robots[i]) + (outcome ? "" : ": no expectation names it") +
            "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string LadderTable(const Ladder& ladder) {
  std::string html = "<p>It " + Escaped(LadderText(ladder)) +
                     ".</p>\n<table><tr><th></th><th>Limit</th><th>What decided</th>"
                     "<th class=\"number\">Margin</th></tr>\n";
  for (std::size_t i = 0; i < ladder.rulings.size(); ++i) {
    const Expectation& one = ladder.expect.list[i];
    const Ruling& ruling = ladder.rulings[i];
    html += "<tr><td>" + Badge(ruling.verdict.outcome) + "</td><td>" + Escaped(one.name) +
            " <span class=\"dim\">" + Escaped(one.asks) + "</span></td><td>" +
            Escaped(Explain(one, ruling)) + "</td><td class=\"number\">" +
            Escaped(MarginText(one, ruling.verdict)) + "</td></tr>\n";
  }
  html += "</table>\n";
  if (!ladder.next_settings.empty()) {
    html += "<p>Settings of the next, for <code>--config</code>:</p><pre>" +
            Escaped(ladder.next_settings) + "</pre>\n";
  }
  return html;
}

// The bytes as base64 (RFC 4648), as a data URL has them.
std::string Base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U;
    };
    const unsigned all = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    text += kDigits[all >> 18U & 63U];
    text += kDigits[all >> 12U & 63U];
    text += i + 1 < bytes.size() ? kDigits[all >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? kDigits[all & 63U] : '=';
  }
  return text;
}

// The expectations that were decided about that instant, their names with commas between.
std::string DecidedAt(double at, const Expectations& expectations, const Judged& judged) {
  std::string names;
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    const Ruling& ruling = judged.rulings[i];
    if (!ruling.why.empty() ||
        std::abs(SecondsOf(ruling.verdict.worth.at) - at) >= kPicturesApart) {
      continue;
    }
    names += (names.empty() ? "" : ", ") + expectations.list[i].name;
  }
  return names;
}

std::string PicturesHtml(const Pictures& pictures, const Expectations& expectations,
                         const Judged& judged) {
  std::string html = "<div class=\"pictures\">";
  const auto figure = [&html](const std::string& what, const std::string& caption) {
    html += "<figure>" + what + "<figcaption>" + Escaped(caption) + "</figcaption></figure>";
  };
  const auto image = [&figure](const std::string& alt, const std::string& png,
                               const std::string& caption) {
    if (png.empty()) return;
    figure("<img alt=\"" + Escaped(alt) + "\" src=\"data:image/png;base64," + Base64(png) + "\">",
           caption);
  };
  for (const Pictures::Picture& picture : pictures.drawn) {
    const std::string when = TimeText(picture.at);
    image("The robot at " + when, picture.png,
          when + ": " + DecidedAt(picture.at, expectations, judged));
    image("What its camera " + picture.camera + " saw at " + when, picture.seen_png,
          when + ": what its camera " + picture.camera + " saw, without its lens");
    if (picture.lidar.empty()) continue;
    figure(picture.lidar, when + ": what its lidar saw, from above; rings are 1 m apart");
  }
  html += "</div>\n";
  if (pictures.why_not.empty()) return html;
  return html + "<p class=\"dim\">No " + (pictures.drawn.empty() ? "" : "more ") +
         "pictures: " + Escaped(pictures.why_not) + ".</p>\n";
}

std::string EventTable(const Occasion& occasion, const Judged& judged) {
  constexpr std::size_t kMost = 400;  // rows; *assumed*
  std::string html = "<table><tr><th>Time</th><th>Kind</th><th>What happened</th></tr>\n";
  for (std::size_t i = 0; i < std::min(judged.events.size(), kMost); ++i) {
    const Evidence::Told& told = judged.events[i];
    html += "<tr><td class=\"number\">" + TimeText(SecondsOf(told.at)) + "</td><td><code>" +
            Escaped(told.event.kind) + "</code></td><td>" + Escaped(TextOf(told, occasion)) +
            "</td></tr>\n";
  }
  html += "</table>\n";
  if (judged.events.size() > kMost) {
    html += "<p class=\"dim\">" + std::to_string(judged.events.size() - kMost) +
            " more are in the recording.</p>\n";
  }
  return html;
}

std::string Facts(const Occasion& occasion, const Judged& judged) {
  std::string html = "<table>\n";
  const auto row = [&html](const std::string& what, const std::string& value) {
    if (value.empty()) return;
    html += "<tr><th>" + Escaped(what) + "</th><td><code>" + Escaped(value) + "</code></td></tr>\n";
  };
  row("Repeat it", occasion.repeat);
  row("Evidence", occasion.recording);
  row("Judge it again", occasion.judge);
  row("Scenario", occasion.source);
  row("Robot", occasion.robot);
  row("Judged by", std::string("understudy ") + kVersion);
  const auto about = [&judged](const char* key) {
    const auto value = judged.about.find(key);
    return value == judged.about.end() ? std::string() : value->second;
  };
  const auto number = [&about](const char* key) {
    return std::strtod(about(key).c_str(), nullptr);
  };
  row("Revision", about("revision"));
  row("Played by", about("version").empty() ? "" : "understudy " + about("version"));
  row("MuJoCo", about("mujoco"));
  row("Started", about("started"));
  if (!about("speed").empty()) {
    row("Speed", number("speed") > 0 ? NumberText(number("speed")) + " simulated s per s"
                                     : "as fast as possible");
  }
  if (!about("timestep_ns").empty()) {
    row("Step of the physics", NumberText(1e-6 * number("timestep_ns")) + " ms");
  }
  row("Profile of sensors", about("profile"));
  row("Seed of sensors", about("sensors_seed"));
  const bool drawn = about("draws") != "[]";
  row("Seed of randomization",
      about("version").empty() || drawn ? about("seed") : "none: nothing was drawn");
  if (drawn) row("Drawn", about("draws"));
  row("The recording was cut short", judged.cut_short);
  return html + "</table>\n";
}

}  // namespace

std::string TellHtml(const Occasion& occasion, const Expectations& expectations,
                     const Judged& judged) {
  const std::size_t failed = judged.failed();
  const std::size_t open = judged.Count(Outcome::kNotJudged);
  const Outcome all = failed > 0 ? Outcome::kFailed
                      : open > 0 ? Outcome::kNotJudged
                                 : Outcome::kPassed;
  const std::string repeats = RepeatsText(occasion);
  std::string html = "<header><h1>" + Badge(all) + " " + Escaped(occasion.title) + "</h1>";
  if (!occasion.about.empty()) html += "<p>" + Escaped(occasion.about) + "</p>";
  html += "<p class=\"dim\">" + Escaped(occasion.robot) + " · " + TimeText(judged.end) +
          " simulated" + (occasion.wall > 0 ? " in " + TimeText(occasion.wall) : "") + " · " +
          std::to_string(judged.Count(Outcome::kPassed)) + " passed, " + std::to_string(failed) +
          " failed, " + std::to_string(open) + " not judged" +
          (occasion.stopped.empty() ? "" : " · " + Escaped(occasion.stopped)) +
          (repeats.empty() ? "" : " · " + Escaped(repeats)) + "</p></header>\n";
  for (const Failure& failure : judged.failures) {
    html += "<p>" + Badge(Outcome::kFailed) + " " + Escaped(failure.name + " " + failure.why) +
            "</p>\n";
  }
  html += "<h2>Verdicts</h2>\n" + Summary(expectations, judged);
  if (occasion.ladder) html += "<h2>Stages</h2>\n" + LadderTable(*occasion.ladder);
  if (!occasion.pictures.drawn.empty() || !occasion.pictures.why_not.empty()) {
    html +=
        "<h2>When it was decided</h2>\n" + PicturesHtml(occasion.pictures, expectations, judged);
  }
  html += "<h2>Evidence</h2>\n";
  for (std::size_t i = 0; i < expectations.list.size(); ++i) {
    html += ClaimHtml(i, occasion, expectations, judged);
  }
  for (std::size_t i = 0; i < judged.damage.size(); ++i) {
    if (!judged.damage[i]) continue;
    const std::string robot = expectations.robots.empty() ? "the robot" : expectations.robots[i];
    html += "<h2>What it would have done to " + Escaped(robot) + "</h2>\n" +
            DamageHtml(*judged.damage[i]);
  }
  html += "<h2>Events</h2>\n" + EventTable(occasion, judged);
  html += "<h2>How to repeat it</h2>\n" + Facts(occasion, judged);
  if (!occasion.scenario.empty()) {
    html += "<h2>What was asked</h2>\n<pre>" + Escaped(occasion.scenario) + "</pre>\n";
  }
  return HtmlPage(occasion.title, html);
}

}  // namespace understudy::rehearse
