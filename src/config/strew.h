// Makes objects of what lies about in a place.
#pragma once

#include "config/config.h"

namespace understudy::config {

// Adds what lies about by terrain.clutter to the objects, so that all that knows objects knows it.
// A printed configuration has them already: it makes the same world.
void StrewObjects(Config* config);

}  // namespace understudy::config
