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

// The order, or one line that says what was expected and what was found.
using OrderReading = std::variant<Order, std::string>;

// Each takes one JSON object. Exactly one of {"lower": m}, {"raise": m}, {"attach": true},
// {"release": true}; m is finite and |m| <= kMostCraneOrder.
OrderReading ReadCraneOrder(std::string_view body);
// {"on": true | false}
OrderReading ReadClampOrder(std::string_view body);
// {} or nothing at all.
OrderReading ReadResetOrder(std::string_view body);

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_ORDER_JSON_H_
