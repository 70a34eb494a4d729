// Sends one request of `understudy ctl` to a running robot.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "client/client.h"

namespace understudy::ctl {

// Longer than the server waits for the tick, so that the server can report the reason.
inline constexpr std::chrono::milliseconds kCallTimeout{5'000};

// Returns the body of the reply. Throws ControlError with the robot's reason if the status is not
// 200. In a program on a simulated clock the timeout is real, and time stands until the reply; a
// longer timeout than kCallTimeout, as for what needs steps, is simulated, and time goes on.
std::string Ask(const std::filesystem::path& socket, const std::string& method,
                const std::string& path, const std::string& body,
                std::chrono::milliseconds timeout = kCallTimeout);

// Returns the body of a reply. Throws ControlError with the robot's reason if its status is not
// 200.
std::string BodyOf(client::ControlReply reply);

// Returns the error for a reply whose JSON is not as expected.
ControlError NotOurVersion(const nlohmann::json::exception& error);

}  // namespace understudy::ctl
