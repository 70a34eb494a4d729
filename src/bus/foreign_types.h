// Keeps Cyclone from reading foreign type information.
//
// Cyclone 0.10.2 asks the owner of an endpoint with an unknown type for a description of that type.
// It takes every answer, asked for or not, and reads through a null pointer where one has a
// collection of what it has no kind for: of int8 or uint8, as ROS 2 on Fast DDS 3 sends. So a
// packet of a stranger's ends the process.
//
// Here two things are known of another's type: its name and, of a Cyclone's, the hash by which
// XTypes tells definitions apart. Two ends match if their names are equal and their hashes, where
// both have one. Nobody is asked for a description, and none is read. Ours are announced as ever,
// and given to whom asks, if the question is not longer than any that makes sense.
//
// This holds where the library calls its own functions by name, as Debian's does; one that was
// linked with -Bsymbolic-functions does not.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::bus {

// The first two bytes of a GUID name its maker. Hashes of others' are not compared: they make other
// ones of the same IDL.
inline constexpr std::array<std::uint8_t, 2> kCyclone{0x01, 0x10};

// Returns whether the loaded libddsc calls `function` of its own by name, so that a program's own
// takes its place. Debian's does for all; one linked with -Bsymbolic-functions, as builds of Ubuntu
// are by default, for none.
bool CycloneCalls(std::string_view function);

// Returns whether Cyclone reads descriptions nonetheless, because of how libddsc was linked.
bool ReadsForeignTypes();

// Throws BusError if this program is linked so that Cyclone reads descriptions nonetheless.
void RequireUnreadTypes();

}  // namespace understudy::bus
