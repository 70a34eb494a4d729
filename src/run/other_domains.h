// Finds programs of this network that are in another DDS domain.
#pragma once

#include <set>
#include <string>

namespace understudy::run {

// Returns the domains, 0 to 100, whose ports of discovery are open, by a table as /proc/net/udp has
// it. Above, ports may be anybody's.
std::set<int> DomainsIn(const std::string& udp_table);

// Returns those of this process's network.
std::set<int> DomainsHere();

}  // namespace understudy::run
