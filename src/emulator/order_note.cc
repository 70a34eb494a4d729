#include "emulator/order_note.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace understudy::emulator {
namespace {

using nlohmann::ordered_json;

void Copy(std::string_view text, std::array<char, 64>* to) {
  *std::copy_n(text.begin(), std::min(text.size(), to->size() - 1), to->begin()) = '\0';
}

std::array<double, 3> Array(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

struct Noter {
  std::string_view base;
  robot::StartPose start;
  OrderNote note;

  void operator()(const ResetRobot& reset) {
    note.kind = OrderKind::kReset;
    Copy(robot::kStartPoses[static_cast<std::size_t>(reset.pose.value_or(start))], &note.what);
  }
  void operator()(const PushBody& push) {
    note.kind = OrderKind::kPush;
    Copy(push.body.empty() ? base : push.body, &note.what);
    note.vector = Array(push.force);
    note.amount = push.seconds;
  }
  void operator()(const DragBody& drag) {
    note.kind = OrderKind::kDrag;
    Copy(drag.body, &note.what);
    note.vector = Array(drag.p_WT);
  }
  void operator()(const ReleaseDrag& release) {
    note.kind = OrderKind::kLetGo;
    Copy(release.body, &note.what);
  }
  void operator()(const StepRun& step) {
    note.kind = OrderKind::kStep;
    note.amount = static_cast<double>(step.steps);
  }
  void operator()(const LowerCrane& lower) {
    note.kind = OrderKind::kLowerCrane;
    note.amount = lower.by;
  }
  template <class Other>
  void operator()(const Other&) {}
};

std::string Text(double number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.4g", number);
  return digits.data();
}

std::string Text(const std::array<double, 3>& vector) {
  return Text(vector[0]) + " " + Text(vector[1]) + " " + Text(vector[2]);
}

}  // namespace

OrderNote NoteOf(const Order& order, double time, std::string_view base, robot::StartPose start) {
  Noter noter{.base = base, .start = start, .note = {.time = time}};
  std::visit(noter, order);
  return noter.note;
}

std::string Describe(const OrderNote& note) {
  const std::string what = note.what.data();
  switch (note.kind) {
    case OrderKind::kReset:
      return "reset to " + what;
    case OrderKind::kPush:
      return "push " + what + " by " + Text(note.vector) + " N for " + Text(note.amount) + " s";
    case OrderKind::kDrag:
      return "drag " + what + " to " + Text(note.vector);
    case OrderKind::kLetGo:
      return "let go of " + (what.empty() ? "all that is dragged" : what);
    case OrderKind::kStep:
      return std::to_string(static_cast<std::int64_t>(note.amount)) +
             (note.amount == 1 ? " step" : " steps");
    case OrderKind::kLowerCrane:
      return (note.amount < 0 ? "crane raised by " : "crane lowered by ") +
             Text(std::abs(note.amount)) + " m";
    case OrderKind::kNone:
      break;
  }
  return {};
}

ordered_json DetailOf(const OrderNote& note) {
  switch (note.kind) {
    case OrderKind::kReset:
      return {{"pose", note.what.data()}};
    case OrderKind::kPush:
      return {{"body", note.what.data()}, {"force", note.vector}, {"seconds", note.amount}};
    case OrderKind::kDrag:
      return {{"body", note.what.data()}, {"to", note.vector}};
    case OrderKind::kLetGo:
      return {{"body", note.what.data()}};
    case OrderKind::kStep:
      return {{"steps", static_cast<std::int64_t>(note.amount)}};
    case OrderKind::kLowerCrane:
      return {{"lower", note.amount}};
    case OrderKind::kNone:
      break;
  }
  return ordered_json::object();
}

}  // namespace understudy::emulator
