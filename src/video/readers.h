// Finds out whether a program of this machine reads a multicast stream.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace understudy::video {

// Returns whether `igmp`, the text of /proc/net/igmp, has a member of the group (dotted) on that
// interface. A text of another form has none.
bool HasJoined(std::string_view igmp, std::string_view interface, const std::string& group);

// Returns whether `udp`, the text of /proc/net/udp, has a socket of that local port.
bool IsOpen(std::string_view udp, int port);

// Returns whether a program in this thread's network reads kGroup at that port on that interface.
bool IsRead(const std::string& interface, int port,
            const std::filesystem::path& net = "/proc/thread-self/net");

}  // namespace understudy::video
