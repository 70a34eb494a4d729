// The report of a campaign as one page.
#include <algorithm>

#include "base/printed.h"
#include "rehearse/campaign_outputs.h"
#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

using judge::Outcome;

constexpr std::size_t kMostMaps = 6;  // *assumed*

constexpr char kCampaignStyle[] = R"css(<style>
.bar { position: relative; display: block; width: 220px; height: 14px; background: var(--line);
       border-radius: 3px; overflow: hidden; }
.bar i { position: absolute; top: 0; bottom: 0; background: var(--good); opacity: .35; }
.bar b { position: absolute; top: 0; bottom: 0; width: 3px; background: var(--good); }
section.axis { margin-bottom: 12px; } table.map { width: auto; } table.map td, table.map th { text-align: center; font-size: 12px;
  padding: 5px 8px; } table.map td { color: #10161d; border-left: 1px solid var(--line); }
.maps { display: flex; flex-wrap: wrap; gap: 22px; } .maps h3 { font-size: 14px; margin: 8px 0; }
table.runs td { font-size: 13px; } .rate { font-size: 40px; font-weight: 600; }
</style>
)css";

std::string Interval(const Tally& tally) {
  const Share share = tally.interval();
  return Percent(share.low) + " to " + Percent(share.high) + " %";
}

std::string Cell(const std::string& text, bool number = false) {
  return std::string(number ? "<td class=\"number\">" : "<td>") + text + "</td>";
}

// The rate as a mark in its interval.
std::string Bar(const Tally& tally) {
  if (tally.judged() == 0) return {};
  const Share share = tally.interval();
  return "<span class=\"bar\"><i style=\"left:" + Percent(share.low) +
         "%;width:" + Percent(share.high - share.low) +
         "%\"></i><b style=\"left:" + Percent(tally.rate()) + "%\"></b></span>";
}

std::string RateCells(const Tally& tally) {
  const bool any = tally.judged() > 0;
  return Cell(std::to_string(tally.passed) + " of " + std::to_string(tally.judged()), true) +
         Cell(any ? Percent(tally.rate()) + " %" : "", true) +
         Cell(any ? Interval(tally) : "", true) + Cell(Bar(tally)) +
         Cell(tally.open == 0 ? "" : std::to_string(tally.open), true);
}
constexpr char kRateHeads[] =
    "<th class=\"number\">Passed</th><th class=\"number\">Rate</th><th class=\"number\">95 % "
    "interval</th><th></th><th class=\"number\">Not judged</th>";

std::string ExpectationTable(const Campaign& campaign) {
  std::string html = "<table><tr><th>Expectation</th>" + std::string(kRateHeads) +
                     "<th>Least margins, by run</th></tr>\n";
  for (const ExpectationSummary& one : campaign.summary.expectations) {
    std::string worst;
    for (const std::size_t i : one.worst) {
      const RunResult& result = campaign.results[i];
      const auto verdict = std::ranges::find(result.verdicts, one.name, &RunVerdict::name);
      worst += (worst.empty() ? "" : ", ") + NumberText(*verdict->margin + 0.0) +
               " <a class=\"dim\" href=\"#r" + std::to_string(result.number) + "\">" +
               std::to_string(result.number) + "</a>";
    }
    if (!worst.empty() && !one.unit.empty()) worst += " [" + Escaped(one.unit) + "]";
    html += "<tr>" + Cell(Escaped(one.name)) + RateCells(one.tally) + Cell(worst) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string AxisTable(const AxisSummary& axis) {
  std::string html =
      "<table><tr><th><code>" + Escaped(axis.key) + "</code></th>" + kRateHeads + "</tr>\n";
  for (std::size_t i = 0; i < axis.labels.size(); ++i) {
    html += "<tr>" + Cell(Escaped(axis.labels[i])) + RateCells(axis.tallies[i]) + "</tr>\n";
  }
  return html + "</table>\n";
}

// The success rate over two keys: red is 0, green 1, nothing where no run was judged.
std::string HeatMap(const Campaign& campaign, const AxisSummary& across, const AxisSummary& down) {
  std::vector<Tally> cells(across.labels.size() * down.labels.size());
  for (std::size_t i = 0; i < campaign.results.size(); ++i) {
    cells[down.groups[i] * across.labels.size() + across.groups[i]].Count(
        campaign.results[i].outcome);
  }
  std::string html = "<div><h3><code>" + Escaped(down.key) + "</code> over <code>" +
                     Escaped(across.key) + "</code></h3><table class=\"map\"><tr><th></th>";
  for (const std::string& label : across.labels) html += "<th>" + Escaped(label) + "</th>";
  html += "</tr>\n";
  for (std::size_t row = 0; row < down.labels.size(); ++row) {
    html += "<tr><th>" + Escaped(down.labels[row]) + "</th>";
    for (std::size_t column = 0; column < across.labels.size(); ++column) {
      const Tally& tally = cells[row * across.labels.size() + column];
      if (tally.judged() == 0) {
        html += "<td></td>";
        continue;
      }
      html +=
          Printed("<td style=\"background:hsl(%.0f,62%%,66%%)\" title=\"", 4 + 136 * tally.rate()) +
          Escaped(down.key + " " + down.labels[row] + ", " + across.key + " " +
                  across.labels[column] + ": " + Percent(tally.rate()) + " %, 95 % interval " +
                  Interval(tally)) +
          "\">" + std::to_string(tally.passed) + " of " + std::to_string(tally.judged()) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string HeatMaps(const Campaign& campaign) {
  const std::vector<AxisSummary>& axes = campaign.summary.axes;
  std::string html;
  std::size_t drawn = 0;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    for (std::size_t b = a + 1; b < axes.size() && drawn < kMostMaps; ++b, ++drawn) {
      html += HeatMap(campaign, axes[b], axes[a]);
    }
  }
  if (html.empty()) return {};
  return "<h2>Success by two values</h2>\n<div class=\"maps\">" + html + "</div>\n";
}

std::string SharedTable(const std::string& title, const std::vector<SharedValue>& shared) {
  if (shared.empty()) return {};
  std::string html = "<h2>" + Escaped(title) +
                     "</h2>\n<table><tr><th>Value</th><th class=\"number\">Of these runs</th><th "
                     "class=\"number\">Of all runs</th>"
                     "<th class=\"number\">By chance</th></tr>\n";
  for (const SharedValue& one : shared) {
    html += "<tr>" + Cell("<code>" + Escaped(one.key) + "</code> " + Escaped(one.label)) +
            Cell(std::to_string(one.there) + " of " + std::to_string(one.of), true) +
            Cell(std::to_string(one.with) + " of " + std::to_string(one.all), true) +
            Cell(NumberText(one.chance), true) + "</tr>\n";
  }
  return html +
         "</table>\n<p class=\"dim\">By chance: the probability that so many or more would "
         "have it if it made no difference, times the number of values looked at.</p>\n";
}

std::string RunTable(const Campaign& campaign) {
  std::string html = "<table class=\"runs\"><tr><th></th><th class=\"number\">Run</th>";
  for (const Axis& axis : campaign.plan.axes()) {
    html += "<th class=\"number\"><code>" + Escaped(axis.key) + "</code></th>";
  }
  html += "<th>What decided</th><th class=\"number\">Margin</th></tr>\n";
  for (const std::size_t i : campaign.summary.order) {
    const RunResult& result = campaign.results[i];
    const std::string number = std::to_string(result.number);
    std::string named = number;
    if (result.kept) {
      named = "<a href=\"" + RunFolder(result.number) +
              (result.broken.empty() ? "/report.html" : "/log.txt") + "\">" + number + "</a>";
    }
    html += "<tr id=\"r" + number + "\" title=\"" + Escaped(result.repeat) + "\">" +
            Cell(Badge(result.outcome)) + Cell(named, true);
    for (const Setting& setting : result.settings) html += Cell(Escaped(setting.text), true);
    const RunVerdict* worst = result.Worst();
    if (!result.broken.empty() || worst == nullptr) {
      html += Cell(Escaped(result.broken)) + Cell("");
    } else {
      const std::string margin = worst->margin ? NumberText(*worst->margin + 0.0) : "";
      html += Cell("<b>" + Escaped(worst->name) + "</b>: " + Escaped(worst->explanation)) +
              Cell(margin.empty() ? "" : margin + " " + Escaped(worst->unit), true);
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string CampaignHtml(const Campaign& campaign) {
  const CampaignSummary& summary = campaign.summary;
  const Tally& tally = summary.tally;
  const Outcome all = tally.failed > 0                      ? Outcome::kFailed
                      : tally.open + campaign.missing() > 0 ? Outcome::kNotJudged
                                                            : Outcome::kPassed;
  std::string html = kCampaignStyle;
  html += "<header><h1>" + Badge(all) + " " + Escaped(campaign.head.title) + "</h1>";
  if (!campaign.head.about.empty()) html += "<p>" + Escaped(campaign.head.about) + "</p>";
  if (tally.judged() > 0) {
    html += "<p><span class=\"rate\">" + Percent(tally.rate()) +
            " %</span> passed; with 95 % "
            "confidence " +
            Interval(tally) + " (Wilson)</p>" + Bar(tally);
  }
  html += "<p class=\"dim\">" + std::to_string(summary.planned) + " runs · " +
          std::to_string(tally.passed) + " passed, " + std::to_string(tally.failed) + " failed, " +
          std::to_string(tally.open) + " not judged" +
          (campaign.missing() > 0 ? " · " + std::to_string(campaign.missing()) + " still to come"
                                  : "") +
          "</p></header>\n";
  html += "<h2>Expectations</h2>\n" + ExpectationTable(campaign);
  html += SharedTable("What the runs that failed share", summary.of_failed);
  html += SharedTable(
      "What the " + std::to_string(summary.worst.size()) + " runs with the least margins share",
      summary.of_worst);
  html += "<h2>Success by value</h2>\n";
  for (const AxisSummary& axis : summary.axes) {
    html += "<section class=\"axis\">" + AxisTable(axis) + "</section>\n";
  }
  html += HeatMaps(campaign);
  html += "<h2>Runs, failures first</h2>\n" + RunTable(campaign);
  html += "<h2>How to repeat it</h2>\n<p>A run by its number, as</p><pre>" +
          Escaped(campaign.head.Repeat(
              campaign.results.empty() ? 1 : campaign.results[summary.order.front()].number)) +
          "</pre>\n<p class=\"dim\">understudy " + Escaped(campaign.head.version) + " · " +
          Escaped(campaign.head.scenario) + "</p>\n";
  html += "<h2>What was asked</h2>\n<pre>" + Escaped(campaign.head.text) + "</pre>\n";
  return HtmlPage(campaign.head.title, html);
}

}  // namespace understudy::rehearse
