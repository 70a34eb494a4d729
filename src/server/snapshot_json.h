// The JSON of GET /snapshot and GET /snapshots.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "emulator/snapshot.h"

namespace understudy::server {

// Returns the parts that a comma-separated list names, none for an empty list. Returns nullopt and
// sets `unknown` to the first word that is not in kSnapshotParts, if there is one.
std::optional<emulator::SnapshotParts> ReadSnapshotParts(std::string_view list,
                                                         std::string* unknown);

// {"step": n, "time": s, "speed": x, "paused": b} and those of `parts` that the snapshot has.
// Numbers have a float's precision, but time and qpos, which have a double's; one that is not
// finite becomes null.
std::string SnapshotJson(const emulator::Snapshot& snapshot, emulator::SnapshotParts parts);

// Returns the settings that can change, with their values in the snapshot, for GET /settings.
nlohmann::ordered_json SettingsJson(const emulator::Snapshot& snapshot);

// Returns the components that can have faults with the names of these, and the kinds of fault, for
// GET /faults. The faults that there are now are a part of the snapshot.
nlohmann::ordered_json FaultsJson(const emulator::Snapshot& snapshot);

}  // namespace understudy::server
