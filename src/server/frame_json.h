// What GET /frame answers and GET /frames sends.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/frame.h"

namespace understudy::server {

// The parts that a comma-separated list names; nullopt, with the word that is none in `unknown`,
// where one is not a name of kFrameParts. An empty list names none.
std::optional<emulator::FrameParts> ReadFrameParts(std::string_view list, std::string* unknown);

// {"step": n, "time": s, "speed": x, "paused": b} and those of `parts` that the frame has. Numbers
// have a float's precision, but time and qpos, which have a double's; one that is not finite
// becomes null.
std::string FrameJson(const emulator::Frame& frame, emulator::FrameParts parts);

}  // namespace understudy::server
