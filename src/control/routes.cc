#include "control/routes.h"

#include <algorithm>
#include <vector>

#include "control/order_json.h"
#include "robot/nearest_word.h"

namespace understudy {
namespace {

using nlohmann::ordered_json;
using Routed = std::variant<HttpReply, Order>;

std::string Text(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Routed FromReading(const OrderReading& reading) {
  if (const auto* why = std::get_if<std::string>(&reading)) return ErrorReply(400, *why);
  return std::get<Order>(reading);
}

Routed GetStatus(const HttpRequest&, const RobotIdentity& identity, const StatusBoard& board) {
  return HttpReply{.status = 200, .body = Text(StatusJson(identity, board.Read())), .allow = {}};
}

Routed PostCrane(const HttpRequest& request, const RobotIdentity&, const StatusBoard&) {
  return FromReading(ReadCraneOrder(request.body));
}

Routed PostClamp(const HttpRequest& request, const RobotIdentity&, const StatusBoard&) {
  return FromReading(ReadClampOrder(request.body));
}

Routed PostReset(const HttpRequest& request, const RobotIdentity&, const StatusBoard&) {
  return FromReading(ReadResetOrder(request.body));
}

Routed PostPush(const HttpRequest& request, const RobotIdentity&, const StatusBoard&) {
  return FromReading(ReadPushOrder(request.body));
}

Routed PostRemote(const HttpRequest& request, const RobotIdentity&, const StatusBoard&) {
  return FromReading(ReadRemoteOrder(request.body));
}

struct Row {
  std::string_view path;
  std::string_view method;
  Routed (*answer)(const HttpRequest&, const RobotIdentity&, const StatusBoard&);
};

constexpr Row kRoutes[] = {
    {"/status", "GET", GetStatus}, {"/crane", "POST", PostCrane}, {"/clamp", "POST", PostClamp},
    {"/reset", "POST", PostReset}, {"/push", "POST", PostPush},   {"/remote", "POST", PostRemote},
};

HttpReply NoSuchPath(std::string_view path) {
  constexpr std::size_t kLongest = 64;
  const std::string shown{path.substr(0, kLongest)};
  std::vector<std::string> paths;
  for (const Row& row : kRoutes) paths.emplace_back(row.path);
  return ErrorReply(404, "no path " + shown + DidYouMean(shown, paths));
}

}  // namespace

HttpReply ErrorReply(unsigned status, std::string_view why) {
  return {.status = status, .body = Text({{"error", why}}), .allow = {}};
}

HttpReply AnswerReply(const Answer& answer) {
  if (!answer.empty()) return ErrorReply(409, answer);
  return {.status = 200, .body = Text({{"ok", true}}), .allow = {}};
}

Routed Route(const HttpRequest& request, const RobotIdentity& identity, const StatusBoard& board) {
  const std::string_view path = request.target.substr(0, request.target.find('?'));
  const auto row = std::find_if(std::begin(kRoutes), std::end(kRoutes),
                                [&](const Row& r) { return r.path == path; });
  if (row == std::end(kRoutes)) return NoSuchPath(path);
  if (row->method != request.method) {
    HttpReply reply = ErrorReply(405, std::string{path} + " takes " + std::string{row->method} +
                                          ", not " + std::string{request.method.substr(0, 32)});
    reply.allow = row->method;
    return reply;
  }
  return row->answer(request, identity, board);
}

}  // namespace understudy
