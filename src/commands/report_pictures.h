// Pictures of the robot for the report of a rehearsal.
#pragma once

#include <filesystem>
#include <vector>

#include "config/config.h"
#include "rehearse/judged.h"
#include "rehearse/outputs.h"

namespace understudy::commands {

// Draws the robot at the instants that decided, those of failures first, by `understudy picture`,
// and what its lidar saw; at the first of them also what its first camera saw. Of several robots it
// is the first that an expectation names. Where that cannot be done, the result says why.
// `recordings` are by number of the robot in `config`; `folder` gets the pictures for a moment.
rehearse::Pictures DrawPictures(const rehearse::Expectations& expect,
                                const rehearse::Judged& judged, const config::Config& config,
                                const std::vector<std::filesystem::path>& recordings,
                                const std::filesystem::path& folder);

}  // namespace understudy::commands
