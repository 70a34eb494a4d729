// Reads the orders that come as JSON.
#ifndef UNDERSTUDY_CONTROL_ORDER_JSON_H_
#define UNDERSTUDY_CONTROL_ORDER_JSON_H_

#include <string>
#include <string_view>
#include <variant>

#include "control/inbox.h"

namespace understudy {

// The most the crane is lowered or raised by one order [m]; *assumed*, several times its height.
inline constexpr double kMostCraneOrder = 10;
inline constexpr double kMostForce = 1e6;    // N, of a push; *assumed*
inline constexpr double kMostSeconds = 1e6;  // that an order lasts; *assumed*

// The order, or one line that says what was expected and what was found.
using OrderReading = std::variant<Order, std::string>;

// Each takes one JSON object. Exactly one of {"lower": m}, {"raise": m}, {"attach": true},
// {"release": true}; m is finite and |m| <= kMostCraneOrder.
OrderReading ReadCraneOrder(std::string_view body);
// {"on": true | false}
OrderReading ReadClampOrder(std::string_view body);
// {} or nothing at all.
OrderReading ReadResetOrder(std::string_view body);
// {"body": name, "force": [x, y, z], "seconds": s}; without "body" the base is pushed.
OrderReading ReadPushOrder(std::string_view body);
// Exactly one of {"press": "L2+B"}, {"hold": keys}, {"release": keys}, {"sticks": {"lx": x, ...}},
// {"on": true | false}; "seconds" beside the first and the fourth.
OrderReading ReadRemoteOrder(std::string_view body);

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_ORDER_JSON_H_
