// Reads the orders that come as JSON.
#ifndef UNDERSTUDY_SERVER_ORDER_JSON_H_
#define UNDERSTUDY_SERVER_ORDER_JSON_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "emulator/inbox.h"
#include "time/pace.h"

namespace understudy::server {

// The most the crane is lowered or raised by one order [m]; *assumed*, several times its height.
inline constexpr double kMostCraneOrder = 10;
inline constexpr double kMostForce = 1e6;              // N, of a push; *assumed*
inline constexpr double kMostSeconds = 1e6;            // that an order lasts; *assumed*
inline constexpr std::int64_t kMostSteps = 1'000'000;  // of one order; *assumed*
// Of a drag; all *assumed*: how far from a body's origin it may take hold, m, how far it may pull
// to, m, and how long it may last without being renewed, s.
inline constexpr double kFarthestOnBody = 10;
inline constexpr double kFarthestInWorld = 1e6;
inline constexpr double kLongestDrag = 60;

// The order, or one line that says what was expected and what was found.
using OrderReading = std::variant<emulator::Order, std::string>;

// Each takes one JSON object. Exactly one of {"lower": m}, {"raise": m}, {"attach": true},
// {"release": true}; m is finite and |m| <= kMostCraneOrder.
OrderReading ReadCraneOrder(std::string_view body);
// {"on": true | false}
OrderReading ReadClampOrder(std::string_view body);
// {"pose": word of kStartPoses}; without one, or nothing at all, the start pose.
OrderReading ReadResetOrder(std::string_view body);
// {"body": name, "force": [x, y, z], "seconds": s}; without "body" the base is pushed.
OrderReading ReadPushOrder(std::string_view body);
// {"body": name, "at": [x, y, z], "to": [x, y, z], "seconds": s}; without "at" the body's origin,
// without "seconds" those of DragBody. Or {"body": name, "release": true}; without "body" all.
OrderReading ReadDragOrder(std::string_view body);
// {"on": true | false}
OrderReading ReadPauseOrder(std::string_view body);
// {"steps": n}; without it one.
OrderReading ReadStepOrder(std::string_view body);
// {"speed": x}, which IsSpeed.
OrderReading ReadSpeedOrder(std::string_view body);
// Exactly one of {"press": "L2+B"}, {"hold": keys}, {"release": keys}, {"sticks": {"lx": x, ...}},
// {"set": {"keys": "L2+B", "lx": x, ...}}, {"on": true | false}; "seconds" beside the first and the
// fourth, always beside the fifth, never beside the others. "keys" may be "" or missing: all are
// up.
OrderReading ReadRemoteOrder(std::string_view body);

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_ORDER_JSON_H_
