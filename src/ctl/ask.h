// One question to a running robot, as `understudy ctl` asks it.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace understudy::ctl {

// Longer than the server's patience with the tick, so that it is the server who says why.
inline constexpr std::chrono::milliseconds kCallTimeout{5'000};

// The body of the reply. Throws ControlError with the robot's reason where it is not 200.
std::string Ask(const std::filesystem::path& socket, const std::string& method,
                const std::string& path, const std::string& body,
                std::chrono::milliseconds timeout = kCallTimeout);

// What to throw where a reply is not made as expected.
ControlError NotOurVersion(const nlohmann::json::exception& error);

}  // namespace understudy::ctl
