// Which request is answered how: the control plane without its transport.
#ifndef UNDERSTUDY_CONTROL_ROUTES_H_
#define UNDERSTUDY_CONTROL_ROUTES_H_

#include <string>
#include <string_view>
#include <variant>

#include "control/inbox.h"
#include "control/status_json.h"

namespace understudy {

struct HttpRequest {
  std::string_view method;
  std::string_view target;  // path and perhaps a query, which is left aside
  std::string_view body;
};

struct HttpReply {
  unsigned status = 200;
  std::string body;   // JSON
  std::string allow;  // the method that the path does take; only beside status 405
};

// {"error": why}, whatever bytes `why` holds.
HttpReply ErrorReply(unsigned status, std::string_view why);

// What an order came to: {"ok": true}, or 409 with the reason.
HttpReply AnswerReply(const Answer& answer);

// A reply at once, or an order that has to be carried out before one is known. Never throws on what
// a client sent.
std::variant<HttpReply, Order> Route(const HttpRequest& request, const RobotIdentity& identity,
                                     const StatusBoard& board);

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_ROUTES_H_
