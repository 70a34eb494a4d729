#include "services/service.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/overloaded.h"
#include "services/parameter.h"

namespace understudy::services {
namespace {

using nlohmann::json;

constexpr std::int64_t kApiVersion = 1;

// Makes the goal of all numbers of the parameter, in the order of the fields, then of `then`.
authority::MotionGoal GoalOf(const ApiRow& row, const AskGoal& effect, const json& parameter) {
  authority::goal::Numbers numbers{};
  std::size_t next = 0;
  const auto add = [&](double value) {
    if (next < numbers.size()) numbers[next++] = value;
  };
  for (const Field& field : row.fields) {
    const auto found = parameter.find(field.key);
    if (found == parameter.end()) continue;
    if (found->is_boolean()) add(found->get<bool>() ? 1 : 0);
    if (found->is_number()) add(found->get<double>());
    if (found->is_array()) std::ranges::for_each(*found, [&](const json& v) { add(v); });
  }
  std::ranges::for_each(effect.then, add);
  return effect.goal(numbers);
}

std::string NameOfSetting(std::string_view name, const Field& field, bool first) {
  return first ? std::string(name) : std::string(name) + "." + std::string(field.key);
}

// Why nothing came of a call, by the worst that the motion service said while it was carried out.
CallRefusal RefusalOf(authority::MotionVerdict verdict, std::int32_t code) {
  switch (verdict) {
    case authority::MotionVerdict::kNotNow:
      return CallRefusal::kState;
    case authority::MotionVerdict::kUnknown:
      return CallRefusal::kGoal;
    case authority::MotionVerdict::kUnable:
      return CallRefusal::kNotSimulated;
    case authority::MotionVerdict::kIgnored:
      return CallRefusal::kIgnored;
    case authority::MotionVerdict::kTaken:
      break;
  }
  return code == kRpcOk ? CallRefusal::kNone : CallRefusal::kCode;
}

constexpr std::int64_t kApply = 101;
constexpr std::int64_t kRenew = 102;

}  // namespace

bool OnlyReads(const ApiRow& row) {
  if (const auto* special = std::get_if<Special>(&row.effect)) return special->only_reads;
  return std::holds_alternative<GiveSetting>(row.effect) ||
         std::holds_alternative<GiveState>(row.effect) ||
         std::holds_alternative<GivePicture>(row.effect);
}

Service::Service(ServiceTable table) : table_(std::move(table)) {
  for (const auto& [name, start] : table_.settings) {
    settings_.emplace(name, json::parse(start));
  }
}

std::string_view Service::NameOf(std::int64_t api_id) const {
  const auto row = std::ranges::find(table_.rows, api_id, &ApiRow::id);
  return row == table_.rows.end() ? std::string_view() : row->name;
}

void Service::Set(std::string_view name, json value) {
  settings_[std::string(name)] = std::move(value);
}

bool Service::IsServed(const authority::MotorOwner& owner) const {
  if (table_.needs_motion && owner.active().empty()) return false;
  return owner.Runs(table_.program);
}

ServiceReply Service::Answer(const ServiceRequest& request, authority::MotorOwner* owner,
                             Lease::Time now, std::string* notice) {
  if (request.api_id == kApiVersion) return {.data = std::string(table_.api_version)};
  const auto row = std::ranges::find(table_.rows, request.api_id, &ApiRow::id);
  if (row == table_.rows.end()) {
    return {.code = kRpcApiNotImplemented, .refusal = CallRefusal::kUnknownApi};
  }
  if (!OnlyReads(*row) && lease_.Denies(request.lease_id, now)) {
    return {.code = kRpcLeaseDenied, .refusal = CallRefusal::kLease};
  }
  ServiceReply bad{.code = row->parameter_code.value_or(table_.parameter_code),
                   .refusal = CallRefusal::kParameter};
  if (request.parameter_bytes > kMostParameterBytes) return bad;
  if (request.binary_bytes > (row->takes_binary ? kMostBinaryBytes : 0)) return bad;
  try {
    const auto parameter = DecodeParameter(request.parameter, row->fields);
    if (!parameter) return bad;
    owner->TakeVerdict();
    ServiceReply reply = Act(*row, *parameter, request.binary_bytes, owner, notice);
    if (reply.refusal == CallRefusal::kNone) {
      reply.refusal = RefusalOf(owner->TakeVerdict(), reply.code);
    }
    return reply;
  } catch (const std::exception& error) {
    *notice = std::string(table_.name) + " " + std::string(row->name) + ": " + error.what();
    return {.code = kRpcServerInternal, .refusal = CallRefusal::kFailed};
  }
}

ServiceReply Service::Act(const ApiRow& row, const json& parameter, std::size_t binary_bytes,
                          authority::MotorOwner* owner, std::string* notice) {
  return std::visit(
      Overloaded{
          [&](const AskGoal& effect) { return Ask(row, effect, parameter, owner); },
          [&](const KeepSetting& effect) {
            for (const Field& field : row.fields) {
              const bool first = &field == &row.fields.front();
              if (const auto value = parameter.find(field.key); value != parameter.end()) {
                settings_[NameOfSetting(effect.name, field, first)] = *value;
              }
            }
            return ServiceReply{};
          },
          [&](const GiveSetting& effect) {
            const auto value = settings_.find(effect.name);
            const bool refused = std::ranges::count(effect.refused_in, owner->state().id) > 0;
            return ServiceReply{.code = refused ? effect.refused : kRpcOk,
                                .data = json{{std::string(effect.key),
                                              value == settings_.end() ? json() : value->second}}
                                            .dump(),
                                .refusal = refused ? CallRefusal::kState : CallRefusal::kNone};
          },
          [&](const GiveState& effect) {
            const robot::MotionState& state = owner->state();
            const int word = effect.word == StateWord::kId ? state.id : state.mode;
            return ServiceReply{.data = json{{std::string(effect.key), word}}.dump()};
          },
          [&](const GivePicture&) {
            ServiceReply reply = Refuse(row);
            reply.picture = true;
            return reply;
          },
          [&](const NoController&) { return Refuse(row); },
          [&](const Special& effect) {
            return effect.answer({.parameter = parameter,
                                  .binary_bytes = binary_bytes,
                                  .owner = owner,
                                  .settings = &settings_,
                                  .notice = notice});
          },
      },
      row.effect);
}

ServiceReply Service::Ask(const ApiRow& row, const AskGoal& effect, const json& parameter,
                          authority::MotorOwner* owner) {
  switch (owner->Ask(GoalOf(row, effect, parameter))) {
    case authority::MotionVerdict::kTaken:
    case authority::MotionVerdict::kIgnored:
      if (!effect.keep.empty()) {
        settings_[std::string(effect.keep)] = parameter.at(std::string(row.fields.front().key));
      }
      return {};
    case authority::MotionVerdict::kNotNow:
      return {.code = effect.not_now.value_or(table_.codes.not_now)};
    case authority::MotionVerdict::kUnknown:
      return {.code = effect.unknown.value_or(table_.codes.unknown)};
    case authority::MotionVerdict::kUnable:
      break;
  }
  return Refuse(row);
}

ServiceReply Service::Refuse(const ApiRow& row) const {
  return {.code = row.unable_code.value_or(table_.codes.unable),
          .refusal = CallRefusal::kNotSimulated};
}

ServiceReply Lease::Answer(std::int64_t api_id, std::string_view parameter, std::int64_t lease_id,
                           Time now) {
  ForgetIfOver(now);
  if (api_id == kRenew) {
    if (id_ == 0 || lease_id != id_) {
      return {.code = kRpcLeaseNotExist, .refusal = CallRefusal::kLease};
    }
    renewed_ = now;
    return {};
  }
  if (api_id != kApply) {
    return {.code = kRpcApiNotImplemented, .refusal = CallRefusal::kUnknownApi};
  }
  const Field name{.key = "name", .type = &kString};
  if (!DecodeParameter(parameter, {&name, 1})) {
    return {.code = kRpcApiParameter, .refusal = CallRefusal::kParameter};
  }
  if (id_ != 0) return {.code = kRpcLeaseExist, .refusal = CallRefusal::kLease};
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  id_ = last_id_ = std::max<std::int64_t>(micros, last_id_ + 1);
  renewed_ = now;
  const auto term = std::chrono::duration_cast<std::chrono::microseconds>(kTerm).count();
  return {.data = nlohmann::json{{"id", id_}, {"term", term}}.dump()};
}

bool Lease::Denies(std::int64_t lease_id, Time now) {
  ForgetIfOver(now);
  return lease_id != id_;
}

void Lease::ForgetIfOver(Time now) {
  if (id_ != 0 && now > renewed_ + kTerm) id_ = 0;
}

}  // namespace understudy::services
