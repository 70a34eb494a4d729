// Logs what was found out while a world was made.
#pragma once

#include <span>

#include "assembly/make_world.h"

namespace understudy::run {

void LogNotes(std::span<const assembly::Note> notes);

}  // namespace understudy::run
