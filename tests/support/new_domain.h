// DDS domains for tests that run side by side.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sys/socket.h>
#include <sys/un.h>

#include "base/unique_fd.h"

namespace understudy::test {

// Returns a domain from 101 to 231 that no other test of this machine has been given. It is this
// process's until its end: an abstract socket of that name is bound, which one process can do, and
// which the kernel undoes.
inline int NewDomain() {
  static std::vector<UniqueFd> held;
  for (int domain = 101; domain < 232; ++domain) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = "understudy-test-domain-" + std::to_string(domain);
    name.copy(address.sun_path + 1, sizeof address.sun_path - 1);  // abstract: begins with 0
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0) continue;
    held.push_back(std::move(socket));
    return domain;
  }
  throw std::runtime_error("no DDS domain is left for this test");
}

}  // namespace understudy::test
