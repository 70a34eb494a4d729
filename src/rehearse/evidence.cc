#include "rehearse/evidence.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "judge/condition.h"
#include "record/player.h"
#include "record/ros2msg.h"
#include "wire/robot_topics.h"

namespace understudy::rehearse {
namespace {

using nlohmann::json;
using Source = Signal::Source;

constexpr std::string_view kFirstCommand = "first_command";

signals::TruthView ViewOf(const record::Truth& truth, const record::BaseAddress& base) {
  const std::span<const double> qpos = truth.qpos, qvel = truth.qvel;
  const bool free = record::HasFreeBase(truth, base);
  return {.base_position = free ? qpos.subspan(base.qpos, 7) : qpos.first(0),
          .base_velocity = free ? qvel.subspan(base.qvel, 6) : qvel.first(0),
          .tau = truth.tau,
          .foot_force = truth.foot_force,
          .hand_force = truth.hand_force,
          .touch = truth.touch,
          .crane_tension = truth.crane_tension,
          .nearest_obstacle = truth.nearest_obstacle};
}

double ValueOf(const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return judge::WordNumber(value.get_ref<const std::string&>());
  return judge::kUnknown;
}

}  // namespace

std::string WrongField(const std::string& type, const std::string& field) {
  try {
    record::FindField(record::RosTypeName(type), field);
  } catch (const RecordError& error) {
    return error.what();
  }
  return {};
}

double Evidence::ValueBefore(const Signal& signal) {
  return signal.of_one_instant() || signal.source == Source::kEventCount ? 0 : judge::kUnknown;
}

Evidence::Evidence(std::vector<Signal> signals, std::uint64_t start, Give give, std::size_t robot)
    : start_(start), give_(std::move(give)), robot_(robot) {
  for (Signal& signal : signals) {
    values_.push_back(ValueBefore(signal));
    const bool own = signal.robot == robot_;
    if (own && signal.origin() == Origin::kMessages) {
      by_topic_[signal.topic].push_back(slots_.size());
    }
    const double word = judge::WordNumber(signal.printed);
    Slot slot{.signal = std::move(signal), .field = {}, .wrong = {}, .word = word, .last = {}};
    if (own && slot.signal.source == Source::kFirstJump) {
      by_topic_[std::string(wire::kLowStateName)].push_back(slots_.size());
      slot.jump.emplace(slot.signal.slots);
    }
    slots_.push_back(std::move(slot));
  }
}

void Evidence::Take(const record::McapChannel& channel, std::string_view ros_type,
                    const record::McapMessage& message) {
  const std::uint64_t since = message.log_time > start_ ? message.log_time - start_ : 0;
  // Longer than any recording: further arithmetic stays in range.
  constexpr std::uint64_t kLatest = std::numeric_limits<judge::Time>::max() / 4;
  const auto at = static_cast<judge::Time>(std::min(since, kLatest));
  if (!now_ || at > *now_) {
    Flush();
    now_ = at;
  }
  if (channel.topic == record::kTruthTopic) {
    TakeTruth(record::DecodeTruth(message.data), channel.metadata);
  } else if (channel.topic == record::kEventTopic) {
    TakeEvent(record::DecodeEvent(message.data));
  } else {
    TakeMessage(record::TopicOnWire(channel), ros_type, message);
  }
}

void Evidence::TakeTruth(const record::Truth& truth, const record::StringMap& metadata) {
  truth_ = true;
  const signals::TruthView view = ViewOf(truth, record::BaseAddress::Of(metadata));
  fixed_base_ = view.base_position.empty();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = slots_[i].signal;
    if (signal.robot != robot_ || signal.source != Source::kTruth) continue;
    if (signal.of_base && fixed_base_) continue;
    if (!signal.object.empty()) {
      TakeObject(truth, metadata, i);
      continue;
    }
    values_[i] = signal.Told(signal.of(view, signal.index));
  }
}

void Evidence::TakeObject(const record::Truth& truth, const record::StringMap& metadata,
                          std::size_t place) {
  Slot& slot = slots_[place];
  const auto at = record::FindObject(slot.signal.object, metadata);
  const bool there = at && at->qpos + 7 <= truth.qpos.size() && at->qvel + 6 <= truth.qvel.size();
  if (!there) {
    values_[place] = judge::kUnknown;
    slot.wrong = slot.signal.name + ": this recording has no object '" + slot.signal.object + "'";
    return;
  }
  values_[place] = slot.signal.of_object({.position = std::span(truth.qpos).subspan(at->qpos, 7),
                                          .velocity = std::span(truth.qvel).subspan(at->qvel, 6)});
}

void Evidence::TakeEvent(const record::RecordedEvent& event) {
  told_ = true;
  const json detail = json::parse(event.detail, nullptr, false);
  const bool fields = detail.is_object();
  const double count = fields && detail.contains("count") ? ValueOf(detail["count"]) : 1;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Signal& signal = slots_[i].signal;
    if (signal.robot != robot_) continue;
    if (signal.source == Source::kFirstJump && event.kind == kFirstCommand && fields) {
      values_[i] = ValueOf(detail.value("jump", json()));
    }
    if (signal.origin() != Origin::kEvents || signal.topic != event.kind) continue;
    const double value =
        fields && detail.contains(signal.field) ? ValueOf(detail[signal.field]) : judge::kUnknown;
    if (signal.source == Source::kEventField) {
      if (judge::IsKnown(value)) values_[i] = value;
    } else if (signal.source != Source::kPrint || value == slots_[i].word) {
      values_[i] += count;
      pulses_ = pulses_ || signal.of_one_instant();
    }
  }
  // Lateness is a matter of the machine.
  if (event.kind != "overrun") events_.push_back({.at = *now_, .event = event});
}

void Evidence::TakeMessage(const std::string& topic, std::string_view ros_type,
                           const record::McapMessage& message) {
  const auto places = by_topic_.find(topic);
  if (places == by_topic_.end()) return;
  for (const std::size_t i : places->second) {
    Slot& slot = slots_[i];
    switch (slot.signal.source) {
      case Source::kArrival:
        values_[i] += 1;
        pulses_ = true;
        break;
      case Source::kGap:
        values_[i] = slot.last ? 1e-9 * static_cast<double>(*now_ - *slot.last) : 0;
        if (!slot.arrived) slot.last = now_;
        slot.arrived = true;
        break;
      case Source::kRate:
        slot.recent.Add(*now_, 1);
        break;
      case Source::kFirstJump:
        TakeJump(topic, ros_type, message.data, i);
        break;
      default:
        if (!slot.field && slot.wrong.empty()) {
          try {
            slot.field = record::FindField(ros_type, slot.signal.field);
          } catch (const RecordError& error) {
            slot.wrong = error.what();
          }
        }
        if (slot.field) {
          const auto value = record::ReadField(*slot.field, message.data);
          if (value) values_[i] = slot.signal.Told(*value);
        }
        break;
    }
  }
}

// A simulated robot says it itself, since it knows which commands it took.
void Evidence::TakeJump(const std::string& topic, std::string_view ros_type,
                        record::ByteSpan message, std::size_t place) {
  if (truth_ || told_) return;
  Slot& slot = slots_[place];
  try {
    if (topic == wire::kLowStateName) {
      slot.jump->TakeState(ros_type, message);
    } else if (const auto jump = slot.jump->TakeCommand(ros_type, message)) {
      values_[place] = *jump;
    }
  } catch (const RecordError& error) {
    slot.wrong = error.what();
  }
}

void Evidence::Flush() {
  if (!now_) return;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (slot.signal.source == Source::kRate) values_[i] = slot.recent.RateAt(*now_);
    if (slot.signal.source != Source::kGap) continue;
    if (!slot.arrived && slot.last) values_[i] = 1e-9 * static_cast<double>(*now_ - *slot.last);
    slot.arrived = false;
  }
  give_(*now_, values_);
  if (!pulses_) return;
  pulses_ = false;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].signal.of_one_instant()) values_[i] = 0;
  }
  give_(*now_ + 1, values_);
}

void Evidence::Finish() { Flush(); }

std::string Evidence::WhyUnknown(std::size_t signal) const {
  const Slot& slot = slots_[signal];
  if (!slot.wrong.empty()) return slot.wrong;
  const Origin origin = slot.signal.origin();
  if (slot.signal.of_base && fixed_base_) {
    return slot.signal.name + " is of a base that moves, and this robot's is fixed";
  }
  if (origin == Origin::kTruth && !truth_) {
    return slot.signal.name + " is the simulation's truth, which this recording does not have";
  }
  if (!slot.signal.why_unknown.empty() && !judge::IsKnown(values_[signal])) {
    return slot.signal.name + " " + std::string(slot.signal.why_unknown);
  }
  if (origin == Origin::kEvents && !told_) {
    return slot.signal.name + " comes from events, which this recording does not have";
  }
  return {};
}

}  // namespace understudy::rehearse
