// Pictures of the robot for the report of a rehearsal.
#pragma once

#include <filesystem>

#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::commands {

// Draws the robot at the instants that decided, those of failures first, by `understudy picture`.
// Where that cannot be done, the result says why. `folder` gets the pictures for a moment.
rehearse::Pictures DrawPictures(const rehearse::Judged& judged,
                                const std::filesystem::path& recording,
                                const std::filesystem::path& folder);

}  // namespace understudy::commands
