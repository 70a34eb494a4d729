#include "record/truth.h"

#include <algorithm>
#include <charconv>

#include "record/cdr_out.h"

namespace understudy::record {
namespace {

constexpr char kBaseQpos[] = "base_qpos", kBaseQvel[] = "base_qvel";
constexpr char kObjectQpos[] = "object_qpos:", kObjectQvel[] = "object_qvel:";

BytesIn Begin(ByteSpan bytes) {
  BytesIn in(bytes);
  const ByteSpan head = in.TakeRaw(kCdrHead);
  if (head[0] != kLittleEndian[0] || head[1] != kLittleEndian[1]) {
    throw RecordError("expected little-endian CDR");
  }
  return in;
}

template <typename Number>
Number TakeNumber(BytesIn* in) {
  in->Align(sizeof(Number), kCdrHead);
  return in->Take<Number>();
}

std::vector<double> TakeNumbers(BytesIn* in) {
  const auto count = TakeNumber<std::uint32_t>(in);
  if (count == 0) return {};
  in->Align(sizeof(double), kCdrHead);
  const ByteSpan raw = in->TakeRaw(std::uint64_t{count} * sizeof(double));
  std::vector<double> numbers(count);
  std::memcpy(numbers.data(), raw.data(), raw.size());
  return numbers;
}

std::string TakeText(BytesIn* in) {
  const ByteSpan raw = in->TakeRaw(TakeNumber<std::uint32_t>(in));
  if (raw.empty()) return {};
  return {reinterpret_cast<const char*>(raw.data()), raw.size() - 1};
}

std::size_t NumberOf(const std::string& key, const StringMap& metadata) {
  std::size_t value = 0;
  if (const auto found = metadata.find(key); found != metadata.end()) {
    const std::string& text = found->second;
    std::from_chars(text.data(), text.data() + text.size(), value);
  }
  return std::min<std::size_t>(value, 1'000'000);
}

}  // namespace

StringMap BaseAddress::metadata() const {
  if (qpos == 0 && qvel == 0) return {};
  return {{kBaseQpos, std::to_string(qpos)}, {kBaseQvel, std::to_string(qvel)}};
}

BaseAddress BaseAddress::Of(const StringMap& metadata) {
  return {.qpos = NumberOf(kBaseQpos, metadata), .qvel = NumberOf(kBaseQvel, metadata)};
}

void AddObjects(const ObjectAddresses& objects, StringMap* metadata) {
  for (const auto& [name, address] : objects) {
    (*metadata)[kObjectQpos + name] = std::to_string(address.qpos);
    (*metadata)[kObjectQvel + name] = std::to_string(address.qvel);
  }
}

std::optional<BaseAddress> FindObject(std::string_view name, const StringMap& metadata) {
  const std::string qpos = kObjectQpos + std::string(name), qvel = kObjectQvel + std::string(name);
  if (!metadata.contains(qpos) || !metadata.contains(qvel)) return {};
  return BaseAddress{.qpos = NumberOf(qpos, metadata), .qvel = NumberOf(qvel, metadata)};
}

bool HasFreeBase(const Truth& truth, const BaseAddress& base) {
  return truth.qpos.size() >= base.qpos + 7 && truth.qvel.size() >= base.qvel + 6 &&
         truth.qpos.size() != truth.qvel.size();
}

bool IsForPictures(std::string_view kind) {
  return kind != "overrun" && kind != "motion" && kind != "gate";
}

void EncodeTruth(const Truth& truth, BytesOut* out) {
  PutCdrHead(out);
  PutNumber(truth.step, out);
  PutNumber(truth.time, out);
  PutNumbers(truth.qpos, out);
  PutNumbers(truth.qvel, out);
  PutNumbers(truth.tau, out);
  PutNumbers(truth.foot_force, out);
  PutNumber(truth.crane_tension, out);
  PutNumber(truth.nearest_obstacle, out);
  PutNumbers(truth.hand_force, out);
  PutNumbers(truth.touch, out);
}

Truth DecodeTruth(ByteSpan bytes) {
  BytesIn in = Begin(bytes);
  Truth truth;
  truth.step = TakeNumber<std::int64_t>(&in);
  truth.time = TakeNumber<double>(&in);
  truth.qpos = TakeNumbers(&in);
  truth.qvel = TakeNumbers(&in);
  truth.tau = TakeNumbers(&in);
  truth.foot_force = TakeNumbers(&in);
  truth.crane_tension = TakeNumber<double>(&in);
  if (in.remaining() > 0) truth.nearest_obstacle = TakeNumber<double>(&in);
  if (in.remaining() > 0) truth.hand_force = TakeNumbers(&in);
  if (in.remaining() > 0) truth.touch = TakeNumbers(&in);
  return truth;
}

void EncodeEvent(const RecordedEvent& event, BytesOut* out) {
  PutCdrHead(out);
  PutNumber(event.step, out);
  PutNumber(event.time, out);
  PutText(event.kind, out);
  PutText(event.text, out);
  PutText(event.detail, out);
}

RecordedEvent DecodeEvent(ByteSpan bytes) {
  BytesIn in = Begin(bytes);
  RecordedEvent event;
  event.step = TakeNumber<std::int64_t>(&in);
  event.time = TakeNumber<double>(&in);
  event.kind = TakeText(&in);
  event.text = TakeText(&in);
  event.detail = TakeText(&in);
  return event;
}

namespace {

// The figures of a motor, in the order of the message between its limits.
using Figure = double robot::MotorDamage::*;

void PutFigures(const Damage& damage, Figure figure, BytesOut* out) {
  PutCount(damage.sheet.motors.size(), out);
  for (const robot::MotorDamage& motor : damage.sheet.motors) PutNumber(motor.*figure, out);
}

using robot::DamageLimit;
using Text = std::string DamageLimit::*;

void PutTexts(const std::vector<DamageLimit>& limits, Text text, BytesOut* out) {
  PutCount(limits.size(), out);
  for (const DamageLimit& one : limits) PutText(one.*text, out);
}

// As many as there are limits.
void TakeTexts(BytesIn* in, Text text, Damage* damage) {
  if (TakeNumber<std::uint32_t>(in) != damage->limits.size()) {
    throw RecordError("expected a text of each figure");
  }
  for (DamageLimit& one : damage->limits) one.*text = TakeText(in);
}

void CheckCount(std::size_t count, const Damage& damage) {
  if (count != damage.sheet.motors.size()) throw RecordError("expected as many figures as joints");
}

void TakeFigures(BytesIn* in, Figure figure, Damage* damage) {
  const std::vector<double> numbers = TakeNumbers(in);
  CheckCount(numbers.size(), *damage);
  for (std::size_t i = 0; i < numbers.size(); ++i) damage->sheet.motors[i].*figure = numbers[i];
}

}  // namespace

void EncodeDamage(const Damage& damage, BytesOut* out) {
  using robot::MotorDamage;
  PutCdrHead(out);
  PutNumber(damage.step, out);
  for (const double number : {damage.sheet.time, damage.sheet.energy, damage.sheet.peak_current,
                              damage.sheet.shock, damage.sheet.worst_tilt}) {
    PutNumber(number, out);
  }
  PutNumber(std::int64_t{damage.sheet.falls}, out);
  PutNumber(damage.trip_c, out);
  PutCount(damage.joints.size(), out);
  for (const std::string& joint : damage.joints) PutText(joint, out);
  PutNumbers(damage.torque_limit, out);
  PutFigures(damage, &MotorDamage::at_torque_limit, out);
  PutNumbers(damage.speed_limit, out);
  for (const Figure figure :
       {&MotorDamage::at_speed_limit, &MotorDamage::hottest_c, &MotorDamage::tripped,
        &MotorDamage::hardest_stop, &MotorDamage::largest_jump}) {
    PutFigures(damage, figure, out);
  }
  PutNumbers(damage.jump_limit, out);
  PutTexts(damage.limits, &DamageLimit::figure, out);
  PutCount(damage.limits.size(), out);
  for (const DamageLimit& one : damage.limits) PutNumber(one.limit, out);
  PutTexts(damage.limits, &DamageLimit::unit, out);
  PutTexts(damage.limits, &DamageLimit::source, out);
}

Damage DecodeDamage(ByteSpan bytes) {
  using robot::MotorDamage;
  BytesIn in = Begin(bytes);
  Damage damage;
  damage.step = TakeNumber<std::int64_t>(&in);
  for (double* number : {&damage.sheet.time, &damage.sheet.energy, &damage.sheet.peak_current,
                         &damage.sheet.shock, &damage.sheet.worst_tilt}) {
    *number = TakeNumber<double>(&in);
  }
  damage.sheet.falls = static_cast<int>(TakeNumber<std::int64_t>(&in));
  damage.trip_c = TakeNumber<double>(&in);
  for (auto left = TakeNumber<std::uint32_t>(&in); left > 0; --left) {
    damage.joints.push_back(TakeText(&in));
  }
  damage.sheet.motors.resize(damage.joints.size());
  damage.torque_limit = TakeNumbers(&in);
  TakeFigures(&in, &MotorDamage::at_torque_limit, &damage);
  damage.speed_limit = TakeNumbers(&in);
  CheckCount(damage.torque_limit.size(), damage);
  CheckCount(damage.speed_limit.size(), damage);
  for (const Figure figure :
       {&MotorDamage::at_speed_limit, &MotorDamage::hottest_c, &MotorDamage::tripped,
        &MotorDamage::hardest_stop, &MotorDamage::largest_jump}) {
    TakeFigures(&in, figure, &damage);
  }
  damage.jump_limit = TakeNumbers(&in);
  CheckCount(damage.jump_limit.size(), damage);
  for (auto left = TakeNumber<std::uint32_t>(&in); left > 0; --left) {
    damage.limits.push_back({.figure = TakeText(&in)});
  }
  const std::vector<double> limits = TakeNumbers(&in);
  if (limits.size() != damage.limits.size()) {
    throw RecordError("expected a limit of each figure");
  }
  for (std::size_t i = 0; i < limits.size(); ++i) damage.limits[i].limit = limits[i];
  TakeTexts(&in, &DamageLimit::unit, &damage);
  TakeTexts(&in, &DamageLimit::source, &damage);
  return damage;
}

}  // namespace understudy::record
