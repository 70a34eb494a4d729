// A program that has joined the group of video streams on lo, at a port of its own or that one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "base/unique_fd.h"
#include "video/multicast_sender.h"

namespace understudy::test {

class Joined {
 public:
  explicit Joined(int port = 0) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, video::kGroup, &at.sin_addr);
    EXPECT_EQ(::bind(socket_.get(), reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
    socklen_t length = sizeof at;
    ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&at), &length);
    port_ = ntohs(at.sin_port);
    ip_mreqn group{};
    group.imr_multiaddr = at.sin_addr;
    group.imr_ifindex = static_cast<int>(::if_nametoindex("lo"));
    EXPECT_EQ(::setsockopt(socket_.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group), 0);
  }

  int port() const { return port_; }

  // Waits up to `seconds` for the next packet; empty: none came.
  std::vector<std::uint8_t> Receive(int seconds = 10) const {
    const timeval patience{.tv_sec = seconds, .tv_usec = seconds == 0 ? 1 : 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::vector<std::uint8_t> packet(2000);
    const ssize_t size = ::recv(socket_.get(), packet.data(), packet.size(), 0);
    packet.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return packet;
  }

 private:
  UniqueFd socket_;
  int port_ = 0;
};

}  // namespace understudy::test
