#include "run/other_domains.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

namespace understudy::run {
namespace {

// DDSI-RTPS 2.2, section 9.6.1: discovery by multicast, and by unicast of the first participant.
constexpr unsigned kMulticast = 7400, kUnicast = 7410, kDomain = 250;
// Of the next one the ports begin at 32650, where Linux gives out its own.
constexpr int kLast = 100;

}  // namespace

std::set<int> DomainsIn(const std::string& udp_table) {
  std::set<int> domains;
  std::istringstream lines(udp_table);
  for (std::string line; std::getline(lines, line);) {
    unsigned port = 0;
    // NOLINTNEXTLINE(cert-err34-c): four digits cannot overflow
    if (std::sscanf(line.c_str(), " %*u: %*8[0-9A-F]:%4x", &port) != 1 || port < kMulticast)
      continue;
    const auto domain = static_cast<int>((port - kMulticast) / kDomain);
    const unsigned place = (port - kMulticast) % kDomain;
    if (domain <= kLast && (place == 0 || place == kUnicast - kMulticast)) domains.insert(domain);
  }
  return domains;
}

std::set<int> DomainsHere() {
  std::ifstream table("/proc/net/udp");
  return DomainsIn({std::istreambuf_iterator<char>(table), {}});
}

}  // namespace understudy::run
