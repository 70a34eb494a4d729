#include "rehearse/stages.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <utility>

#include "assembly/sight_model.h"
#include "base/errors.h"
#include "base/printed.h"
#include "physics/scene_reader.h"
#include "rehearse/yaml_values.h"
#include "signals/bound_condition.h"

namespace understudy::rehearse {
namespace {

using schema::YamlValue;
using Kind = YamlValue::Kind;

// *Assumed*: letters, and the bounds of what a stage may ask for.
constexpr std::size_t kMostStageName = 80;
constexpr double kMostMargin = 3;   // rad
constexpr double kMostRate = 1000;  // Hz

using schema::kNumber;

struct StageLimit {
  schema::Field field;
  std::optional<double> StageSpec::*value;
};
constexpr schema::Range UpTo(double most) { return {.min = 0, .max = most, .above = true}; }
constexpr StageLimit kStageLimits[] = {
    {{"torque", &kNumber, "", UpTo(1), "Share of each motor's torque_limit"}, &StageSpec::torque},
    {{"speed", &kNumber, "", UpTo(1), "Share of each motor's no_load_speed"}, &StageSpec::speed},
    {{"joint_margin", &kNumber, "rad", UpTo(kMostMargin),
      "That each joint keeps from the ends of its range"},
     &StageSpec::joint_margin},
    {{"command_rate", &kNumber, "Hz", UpTo(kMostRate),
      "Of `rt/lowcmd` at least, from its first message until the program ends"},
     &StageSpec::command_rate},
};

std::vector<schema::Field> StageFields() {
  std::vector<schema::Field> fields{
      {"name", &schema::kTree, "", {}, "Of the stage; needed", "a text"}};
  for (const StageLimit& limit : kStageLimits) fields.push_back(limit.field);
  return fields;
}

StageSpec ReadStage(const YamlValue& value) {
  if (value.kind != Kind::kMap) {
    Refuse(value, "stages", "a stage, as in {name: crawl, torque: 0.5, speed: 0.3}");
  }
  const std::vector<schema::Field> fields = StageFields();
  const schema::Mapping keys(value, fields);
  const YamlValue* name = value.Find("name");
  if (name == nullptr) throw ConfigError(value.where + ": stages: name: missing");
  StageSpec stage{.name = LineOf(*name, "name", kMostStageName), .where = value.where};
  bool any = false;
  for (const StageLimit& limit : kStageLimits) {
    const auto taken = keys.Take(limit.field.key);
    if (!taken) continue;
    stage.*limit.value = taken->number;
    any = true;
  }
  if (!any) {
    throw ConfigError(value.where + ": stages: '" + stage.name +
                      "' has no limit; expected torque, speed, joint_margin or command_rate");
  }
  return stage;
}

// A comparison of every joint, all of which have to hold, in one expectation.
class LimitBuilder {
 public:
  LimitBuilder(const signals::Names& names, Ladder* ladder) : names_(names), ladder_(ladder) {}

  void Add(const std::string& condition) {
    auto bound = signals::BindCondition(condition, names_, &ladder_->expect.signals);
    if (!bound) throw SetupError("a bug: " + condition + ": " + bound.why());
    one_.claim.formula.parts.push_back(std::move(bound->formula));
    for (signals::LeafText& leaf : bound->leaves) {
      const auto place = std::ranges::lower_bound(one_.signals, leaf.signal);
      if (place == one_.signals.end() || *place != leaf.signal) {
        one_.signals.insert(place, leaf.signal);
      }
      one_.leaves.push_back(std::move(leaf));
    }
  }

  void Finish(std::size_t stage, const StageLimit& limit, std::optional<double> to) {
    if (one_.leaves.empty()) return;  // no motor has such a limit
    const StageSpec& of = ladder_->stages[stage];
    one_.name = of.name + ": " + std::string(limit.field.key);
    one_.asks = std::string(limit.field.key) + " " + Printed("%.6g", *(of.*limit.value));
    one_.where = of.where;
    one_.claim.op = judge::Operator::kAlways;
    one_.claim.formula.op = judge::Op::kAll;
    if (to) one_.claim.to.at = static_cast<judge::Time>(std::llround(*to * 1e9));
    judge::NumberLeaves(&one_.claim.formula);
    ladder_->expect.list.push_back(std::move(one_));
    ladder_->stage_of.push_back(stage);
    one_ = {.name = {}};
  }

 private:
  const signals::Names& names_;
  Ladder* ladder_;
  Expectation one_{.name = {}};
};

// Within -bound and bound.
std::string Within(const std::string& signal, double low, double high) {
  return signal + " between " + Printed("%.6g", low) + " and " + Printed("%.6g", high);
}

struct JointEnds {
  std::string joint;
  double low, high;
};

// The ranges of the joints that motors move, of those that have one.
std::vector<JointEnds> EndsOf(const config::Config& config) {
  physics::SceneReader reader([&config] { return assembly::SightModel(config).Get(); });
  const physics::Scene scene = reader.Describe();
  std::vector<JointEnds> ends;
  for (const robot::MotorSpec& motor : config.robots[0].spec.motors) {
    for (const auto& joint : scene.joints) {
      if (joint.name == motor.joint && joint.limited) {
        ends.push_back({motor.joint, joint.range[0], joint.range[1]});
      }
    }
  }
  return ends;
}

// Until when commands are expected: the end of the program, if it ended.
std::optional<double> EndOfCommands(const Judged& judged) {
  for (const Evidence::Told& told : judged.events) {
    if (told.event.kind == "program_end") return SecondsOf(told.at);
  }
  return std::nullopt;
}

std::string SettingsOf(const StageSpec& stage, const config::Config& config,
                       const std::vector<JointEnds>& ends) {
  std::string text = "# The limits of stage '" + stage.name + "' (" + stage.where +
                     "): understudy run " + config.robots[0].spec.name + " --config FILE\n";
  if (stage.torque || stage.speed) {
    text += "robot:\n  motors:\n";
    for (const robot::MotorSpec& motor : config.robots[0].spec.motors) {
      std::string values;
      const auto add = [&values](const char* key, double value) {
        values += std::string(values.empty() ? "" : ", ") + key + ": " + Printed("%.6g", value);
      };
      if (stage.torque) add("torque_limit", *stage.torque * motor.torque_limit);
      if (stage.speed) {
        add("knee_speed", *stage.speed * motor.knee_speed);
        add("no_load_speed", *stage.speed * motor.no_load_speed);
      }
      text += "    " + motor.joint + ": {" + values + "}\n";
    }
  }
  if (stage.command_rate)
    text += "gate: {timeout: " + Printed("%.6g", 1 / *stage.command_rate) + "}\n";
  if (stage.joint_margin) {
    text += "# Joints keep within\n";
    for (const JointEnds& one : ends) {
      text += "#   " + one.joint + " " + Printed("%.6g", one.low + *stage.joint_margin) + " to " +
              Printed("%.6g", one.high - *stage.joint_margin) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<StageSpec> ReadStages(const YamlValue& list) {
  if (list.kind != Kind::kSequence || list.items.empty()) {
    Refuse(list, "stages", "a list of stages, as in [{name: crawl, torque: 0.5, speed: 0.3}]");
  }
  std::vector<StageSpec> stages;
  for (const YamlValue& item : list.items) {
    StageSpec stage = ReadStage(item);
    const auto same = std::ranges::find(stages, stage.name, &StageSpec::name);
    if (same != stages.end()) {
      throw ConfigError(item.where + ": stages: '" + stage.name + "' is the name of that at " +
                        same->where);
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

bool Ladder::Holds(std::size_t stage) const {
  for (std::size_t i = 0; i < rulings.size(); ++i) {
    if (stage_of[i] == stage && rulings[i].verdict.outcome != judge::Outcome::kPassed) return false;
  }
  return true;
}

Ladder JudgeLadder(const Recordings& recordings, const std::vector<StageSpec>& stages,
                   const config::Config& config, const Judged& judged) {
  Ladder ladder{.stages = stages};
  const signals::Names names = signals::RecordedNames(config.robots[0].spec, WrongField);
  std::vector<JointEnds> ends;
  if (std::ranges::any_of(stages,
                          [](const StageSpec& one) { return one.joint_margin.has_value(); })) {
    ends = EndsOf(config);
  }
  LimitBuilder builder(names, &ladder);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    for (const StageLimit& limit : kStageLimits) {
      if (!(stages[i].*limit.value)) continue;
      const double value = *(stages[i].*limit.value);
      std::optional<double> to;
      if (limit.field.key == "joint_margin") {
        for (const JointEnds& one : ends) {
          if (one.low + value >= one.high - value) {
            throw ConfigError(stages[i].where +
                              ": stages: joint_margin: " + Printed("%.6g", value) + " leaves " +
                              one.joint + " no room between " + Printed("%.6g", one.low) + " and " +
                              Printed("%.6g", one.high));
          }
          builder.Add(Within("q(" + one.joint + ")", one.low + value, one.high - value));
        }
      } else if (limit.field.key == "command_rate") {
        to = EndOfCommands(judged);
        builder.Add("gap(rt/lowcmd) <= " + Printed("%.6g", 1 / value));
      } else {
        const bool torque = limit.field.key == "torque";
        for (const robot::MotorSpec& motor : config.robots[0].spec.motors) {
          const double most = value * (torque ? motor.torque_limit : motor.no_load_speed);
          if (most <= 0) continue;  // none is known
          builder.Add(Within((torque ? "torque(" : "dq(") + motor.joint + ")", -most, most));
        }
      }
      builder.Finish(i, limit, to);
    }
  }
  if (!ladder.expect.list.empty()) {
    ladder.rulings = JudgeRecordings(recordings, ladder.expect).rulings;
  }
  const bool sound = judged.Count(judge::Outcome::kPassed) == judged.rulings.size();
  while (sound && ladder.held < stages.size() && ladder.Holds(ladder.held)) ++ladder.held;
  if (ladder.held < stages.size()) {
    ladder.next_settings = SettingsOf(stages[ladder.held], config, ends);
  }
  return ladder;
}

std::string LadderText(const Ladder& ladder) {
  const std::size_t of = ladder.stages.size();
  std::string text = "may go up to no stage";
  if (ladder.held > 0) {
    text = "may go up to stage '" + ladder.stages[ladder.held - 1].name + "', " +
           std::to_string(ladder.held) + " of " + std::to_string(of);
  }
  if (ladder.held < of) text += "; next is '" + ladder.stages[ladder.held].name + "'";
  return text;
}

std::string StagesReference() { return schema::MarkdownRows(StageFields(), "stages[]."); }

}  // namespace understudy::rehearse
