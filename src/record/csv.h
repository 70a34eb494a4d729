// Writes recordings as comma-separated values (RFC 4180), for spreadsheets and programs.
#pragma once

#include <filesystem>

#include "record/recording_reader.h"
#include "record/run_reader.h"

namespace understudy::record {

// Writes a header and a row for each time at which the recording says something, in the order of
// the file: "time [s]" of simulated time, the base's height and attitude, the motors' fields, the
// signals, each under its name with its unit, and what happened. What nobody says at that time is
// empty. With a `second`, whose robot has the same slots, a column "recording" comes first, and
// its rows follow with `shift` s added to their times. Replaces an existing file once the new one
// is whole. Throws as RunReader, and RecordError if the file cannot be written.
void WriteCsv(const RecordingReader& first, const RecordingReader* second, double shift,
              const RunChoice& choice, const std::filesystem::path& file);

}  // namespace understudy::record
