// Says what of a recording could not be read.
#pragma once

#include <cstdio>
#include <string>

#include "record/recording_reader.h"

namespace understudy::commands {

// On standard error; nothing of a whole one. To be called after its messages were read, since
// damage of a finished file is found only then.
inline void TellCutShort(const record::RecordingReader& reader) {
  const std::string& why = reader.contents().cut_short;
  if (why.empty()) return;
  std::fprintf(stderr, "%s was cut short: %s\n", reader.path().c_str(), why.c_str());
}

}  // namespace understudy::commands
