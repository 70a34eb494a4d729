#include "ctl/ask.h"

#include <optional>
#include <utility>

#include "simclock/standing_time.h"

namespace understudy::ctl {
namespace {

using nlohmann::json;

// Returns the "error" of a reply whose status is not 200.
std::string ReasonOf(const client::ControlReply& reply) {
  const json body = json::parse(reply.body, nullptr, false);
  if (body.is_object() && body.contains("error") && body["error"].is_string()) {
    return body["error"];
  }
  return "the robot answered with HTTP status " + std::to_string(reply.status);
}

}  // namespace

std::string Ask(const std::filesystem::path& socket, const std::string& method,
                const std::string& path, const std::string& body,
                std::chrono::milliseconds timeout) {
  std::optional<simclock::StandingTime> stands;
  if (timeout <= kCallTimeout) stands.emplace();
  return BodyOf(client::Call(socket, method, path, body, timeout));
}

std::string BodyOf(client::ControlReply reply) {
  if (reply.status != 200) throw ControlError(ReasonOf(reply));
  return std::move(reply.body);
}

ControlError NotOurVersion(const json::exception& error) {
  return ControlError(std::string{"the robot uses another version of the control plane: "} +
                      error.what());
}

}  // namespace understudy::ctl
