// What is remembered of an order that was carried out.
#ifndef UNDERSTUDY_EMULATOR_ORDER_NOTE_H_
#define UNDERSTUDY_EMULATOR_ORDER_NOTE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "emulator/order.h"

namespace understudy::emulator {

// The kinds of orders that leave no other trace in a Status.
enum class OrderKind : std::uint8_t { kNone, kReset, kPush, kDrag, kLetGo, kStep, kLowerCrane };

// The word that recordings and the control plane use.
constexpr std::string_view Name(OrderKind kind) {
  constexpr std::array<std::string_view, 7> kNames = {"none",   "reset", "push",       "drag",
                                                      "let_go", "step",  "crane_lower"};
  return kNames[static_cast<std::size_t>(kind)];
}

// Plain values, so that the tick can keep it.
struct OrderNote {
  OrderKind kind = OrderKind::kNone;
  double time = 0;                 // simulated s
  std::array<char, 64> what{};     // body, cut to fit, "" = all; of a reset the pose
  std::array<double, 3> vector{};  // push: N, drag: to where in the world, m
  double amount = 0;               // push: s, step: steps, crane_lower: m
};

// The note of an order that was carried out at `time` [s]; kNone for what a Status shows anyway.
// `base` is who is pushed where no body is named, `start` the pose where none is. Allocates
// nothing.
OrderNote NoteOf(const Order& order, double time, std::string_view base, robot::StartPose start);

// "push base_link by 0 50 0 N for 0.1 s"
std::string Describe(const OrderNote& note);
// {"body": "base_link", "force": [0, 50, 0], "seconds": 0.1}, the words of the order's own JSON.
nlohmann::ordered_json DetailOf(const OrderNote& note);

// The newest notes, by number: that of the n-th order, from 0, lies at n % size.
struct OrderNotes {
  std::uint64_t count = 0;  // since start
  std::array<OrderNote, 8> newest{};

  void Add(const OrderNote& note) {
    if (note.kind != OrderKind::kNone) newest[count++ % newest.size()] = note;
  }
  // The number of the oldest that is kept.
  std::uint64_t oldest() const { return count - (count < newest.size() ? count : newest.size()); }
  const OrderNote& operator[](std::uint64_t number) const { return newest[number % newest.size()]; }
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_ORDER_NOTE_H_
