#include "doctor/system.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include <ifaddrs.h>
#include <linux/if_link.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timex.h>

#include "base/files.h"
#include "base/unique_fd.h"
#include "doctor/probe.h"
#include "time/realtime.h"

namespace understudy::doctor {
namespace {

// IFF_LOWER_UP of <linux/if.h>, which cannot be included beside <net/if.h>: the carrier as it is
// now. IFF_RUNNING follows it up to a second late.
constexpr unsigned kLowerUp = 1U << 16U;

// Calls visit(const ifaddrs&) for each address of each interface. They are those of this network;
// /sys/class/net would show the machine's in a private one.
template <class Visit>
void ForEachAddress(Visit&& visit) {
  ifaddrs* head = nullptr;
  if (::getifaddrs(&head) != 0) return;
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owner(head, &::freeifaddrs);
  for (const ifaddrs* one = head; one != nullptr; one = one->ifa_next) visit(*one);
}

std::uint32_t Number(const sockaddr* address) {
  sockaddr_in ipv4{};
  std::memcpy(&ipv4, address, sizeof ipv4);
  return ntohl(ipv4.sin_addr.s_addr);
}

std::string FirstWord(const std::filesystem::path& file) {
  std::istringstream text(FileText(file));
  std::string word;
  text >> word;
  return word;
}

double Seconds(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

}  // namespace

std::optional<LinkState> ReadLink(const std::string& interface) {
  std::optional<LinkState> link;
  ForEachAddress([&](const ifaddrs& one) {
    if (link || interface != one.ifa_name) return;
    const auto has = [&](unsigned flag) { return (one.ifa_flags & flag) != 0; };
    link = LinkState{.up = has(IFF_UP),
                     .running = has(kLowerUp),
                     .multicast = has(IFF_MULTICAST),
                     .loopback = has(IFF_LOOPBACK)};
  });
  return link;
}

std::vector<Address> ReadAddresses() {
  std::vector<Address> addresses;
  ForEachAddress([&](const ifaddrs& one) {
    const bool ipv4 = one.ifa_addr != nullptr && one.ifa_addr->sa_family == AF_INET;
    if (!ipv4 || one.ifa_netmask == nullptr || (one.ifa_flags & IFF_UP) == 0) return;
    addresses.push_back({.interface = one.ifa_name,
                         .address = Number(one.ifa_addr),
                         .mask = Number(one.ifa_netmask)});
  });
  return addresses;
}

std::uint32_t OwnAddress(const std::vector<Address>& addresses, const std::string& interface) {
  const auto own = std::ranges::find(addresses, interface, &Address::interface);
  return own == addresses.end() ? 0 : own->address;
}

std::optional<std::string> ReadMulticastRoute() {
  const std::string table = FileText("/proc/net/route");
  if (table.empty()) return std::nullopt;
  return RouteTo(kDiscoveryGroup, table);
}

std::string RouteTo(std::uint32_t address, std::string_view table) {
  constexpr unsigned long kUp = 1, kReject = 0x200;  // RTF_UP, RTF_REJECT of route(8)
  constexpr int kHex = 16;
  std::istringstream text{std::string(table)};
  std::string line;
  std::getline(text, line);  // the names of the columns
  std::string leads;
  std::pair<std::uint32_t, std::int64_t> best{0, std::numeric_limits<std::int64_t>::min()};
  while (std::getline(text, line)) {
    std::istringstream columns(line);
    std::string name, to, gateway, flags, references, uses, metric, mask;
    if (!(columns >> name >> to >> gateway >> flags >> references >> uses >> metric >> mask))
      continue;
    // Addresses are hexadecimal and in the network's byte order.
    const auto number = [](const std::string& hex) {
      return ntohl(static_cast<std::uint32_t>(std::strtoul(hex.c_str(), nullptr, kHex)));
    };
    const unsigned long is = std::strtoul(flags.c_str(), nullptr, kHex);
    if ((is & kUp) == 0 || (address & number(mask)) != number(to)) continue;
    // The longest mask, and among equals the least metric.
    const std::pair<std::uint32_t, std::int64_t> rank{number(mask),
                                                      -std::strtoll(metric.c_str(), nullptr, 10)};
    if (rank < best) continue;
    best = rank;
    leads = (is & kReject) != 0 ? "" : name;
  }
  return leads;
}

std::optional<DropCounts> ReadDropCounts(const std::string& interface) {
  std::optional<DropCounts> counts;
  ForEachAddress([&](const ifaddrs& one) {
    const bool link = one.ifa_addr != nullptr && one.ifa_addr->sa_family == AF_PACKET;
    if (!link || one.ifa_data == nullptr || interface != one.ifa_name) return;
    rtnl_link_stats stats{};
    std::memcpy(&stats, one.ifa_data, sizeof stats);
    // Not rx_dropped: packets of protocols that nobody here speaks are among these.
    counts =
        DropCounts{.interface_errors = std::uint64_t{stats.rx_errors} + stats.tx_errors,
                   .interface_dropped = std::uint64_t{stats.rx_missed_errors} + stats.tx_dropped};
  });
  const auto full = FullBuffers(FileText("/proc/net/snmp"));
  if (!counts || !full) return std::nullopt;
  counts->buffer_full = *full;
  return counts;
}

std::optional<std::uint64_t> FullBuffers(std::string_view snmp) {
  // Two lines, names and values, in one order.
  std::istringstream text{std::string(snmp)};
  std::string names, values;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("Udp:")) continue;
    (names.empty() ? names : values) = line;
  }
  std::istringstream name_stream(names), value_stream(values);
  std::string name, value;
  while (name_stream >> name && value_stream >> value) {
    if (name == "RcvbufErrors") return std::strtoull(value.c_str(), nullptr, 10);
  }
  return std::nullopt;
}

std::optional<int> GrantedBuffer(bool receive, int wanted) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.valid()) return std::nullopt;
  const int option = receive ? SO_RCVBUF : SO_SNDBUF;
  int granted = 0;
  socklen_t size = sizeof granted;
  if (::getsockopt(socket.get(), SOL_SOCKET, option, &granted, &size) != 0) return std::nullopt;
  if (granted >= wanted) return granted;
  ::setsockopt(socket.get(), SOL_SOCKET, option, &wanted, sizeof wanted);
  if (::getsockopt(socket.get(), SOL_SOCKET, option, &granted, &size) != 0) return std::nullopt;
  return granted;
}

Rights TryRights() {
  time::RealtimeGrant grant;
  std::thread([&] { grant = time::RequestRealtime(); }).join();
  if (grant.locked) ::munlockall();
  rlimit priority{}, memory{};
  ::getrlimit(RLIMIT_RTPRIO, &priority);
  ::getrlimit(RLIMIT_MEMLOCK, &memory);
  return {.fifo = grant.fifo,
          .locked = grant.locked,
          .priority_limit = priority.rlim_cur,
          .memory_limit = memory.rlim_cur};
}

std::vector<std::string> ReadGovernors() {
  std::vector<std::string> governors;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/sys/devices/system/cpu", error)) {
    const std::string governor = FirstWord(entry.path() / "cpufreq" / "scaling_governor");
    if (!governor.empty()) governors.push_back(governor);
  }
  std::ranges::sort(governors);
  governors.erase(std::unique(governors.begin(), governors.end()), governors.end());
  return governors;
}

std::optional<double> ReadLoad() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

std::string ReadClockSource() {
  return FirstWord("/sys/devices/system/clocksource/clocksource0/current_clocksource");
}

std::optional<ClockSync> ReadClockSync() {
  timex kernel{};  // modes 0: only reads, for everybody
  if (::adjtimex(&kernel) < 0) return std::nullopt;
  return ClockSync{.synchronised = (kernel.status & STA_UNSYNC) == 0,
                   .error = static_cast<double>(kernel.maxerror) * 1e-6};
}

void ClockWatch::Note(double before, double system, double after) {
  if (after - before > kClockStep / 10) return;
  const double offset = system - (before + after) / 2;
  const double jump = offset_ ? offset - *offset_ : 0;
  offset_ = offset;
  if (std::abs(jump) <= kClockStep) return;
  ++course_.steps;
  if (std::abs(jump) > std::abs(course_.largest)) course_.largest = jump;
}

void ClockWatch::Note() {
  const double before = Seconds(CLOCK_MONOTONIC);
  const double system = Seconds(CLOCK_REALTIME);
  Note(before, system, Seconds(CLOCK_MONOTONIC));
}

}  // namespace understudy::doctor
