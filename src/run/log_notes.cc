#include "run/log_notes.h"

#include <spdlog/spdlog.h>

namespace understudy::run {

void LogNotes(std::span<const assembly::Note> notes) {
  // In the order of Note::Level.
  constexpr spdlog::level::level_enum kLevels[] = {spdlog::level::debug, spdlog::level::info,
                                                   spdlog::level::warn};
  for (const assembly::Note& note : notes) {
    spdlog::log(kLevels[static_cast<int>(note.level)], "{}", note.text);
  }
}

}  // namespace understudy::run
