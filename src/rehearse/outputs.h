// Tells the judgement of a rehearsal: to a terminal, to CI, to programs and to people.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/expectations.h"
#include "rehearse/judged.h"
#include "rehearse/stages.h"

namespace understudy::rehearse {

// Nearer instants look alike and have one picture, s; *assumed*.
inline constexpr double kPicturesApart = 0.1;

// Pictures of the robot, and of what it saw.
struct Pictures {
  struct Picture {
    double at = 0;           // simulated s
    std::string png{};       // the robot, as a file; "": not drawn
    std::string camera{};    // a camera of the robot; "": it has none
    std::string seen_png{};  // what that saw, as a file; "": not drawn
    std::string lidar{};     // what its lidar saw from above, as <svg>; "": it had no cloud
  };
  std::vector<Picture> drawn{};
  std::string why_not{};  // pictures are missing; else ""
};

// What was rehearsed, as the outputs name it.
struct Occasion {
  std::string title{};
  std::string about{};
  std::string robot{};
  std::string source{};               // the scenario's file
  std::string recording{};            // the evidence
  std::string judge{};                // the command line that judges it again
  std::string repeat{};               // the command line that does the same again
  std::string scenario{};             // text of the file
  std::vector<std::string> script{};  // what its events ask for
  std::string stopped{};              // why it ended before its time; else ""
  std::string clock{};                // "real" or "simulated" of its program; "" without one
  double think = 0;                   // ms of the program, on the simulated clock
  std::optional<double> computed{};   // ms that it computed, as simclock::MedianComputed has it
  std::string unrepeatable{};         // why two runs differ or may; "": no cause is known
  std::optional<bool> repeats{};      // the same was played before and said the same
  std::optional<Ladder> ladder{};     // of a scenario with stages
  Pictures pictures{};                // for the report
  double wall = 0;                    // s that it took; 0 if it was not run now
};

// "clock: simulated, think: 2.5 ms, repeatable: yes"; "" where nothing is to be said.
std::string RepeatsText(const Occasion& occasion);

// Lines for a terminal, one an expectation, with a summary at the end. `colored`: for a terminal.
std::string TellLines(const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged, bool colored);

// JSON for programs (docs/rehearsing.md).
std::string TellJson(const Occasion& occasion, const Expectations& expectations,
                     const Judged& judged);

// JUnit's XML: a test suite with a test case per expectation; those not judged are skipped.
std::string TellJunit(const Occasion& occasion, const Expectations& expectations,
                      const Judged& judged);

// One HTML page that needs no other file, network or script.
std::string TellHtml(const Occasion& occasion, const Expectations& expectations,
                     const Judged& judged);

// A page with that content, in the style of the report.
std::string HtmlPage(const std::string& title, const std::string& content);

// Returns a damage sheet as a part of HtmlPage: the most that it would have done to the robot, and
// to each motor. A figure that is none is left out, one beyond its limit marked.
std::string DamageHtml(const record::Damage& damage);

// Returns an outcome as a word of four letters, `colored` for a terminal, and as a class and a
// badge of HtmlPage.
const char* Word(judge::Outcome outcome, bool colored);
std::string HtmlClass(judge::Outcome outcome);
std::string Badge(judge::Outcome outcome);

}  // namespace understudy::rehearse
