// Enters private networks with one's own or fewer rights, for tests, and looks around in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include "base/unique_fd.h"
#include "exec/private_network.h"
#include "forked.h"

namespace understudy::exec {

// Throws with errno unless `held`.
void Check(bool held, const char* what);

// With what rights the network is entered. A test run by an ordinary user has that user's in all.
enum class Rights { kAsStarted, kOrdinaryUser, kRootOfAContainer };

// For ::testing::PrintToString.
void PrintTo(Rights rights, std::ostream* out);

// Gives up the other rights of this process.
void Take(Rights rights);

sockaddr_in Address(const char* ip, std::uint16_t port);
const sockaddr* Generic(const sockaddr_in& address);

constexpr std::uint16_t kDiscoveryPort = 7400;  // of DDS on domain 0

// Receives what is sent to the DDS discovery group; names no interface, as many programs do.
class GroupSocket {
 public:
  GroupSocket() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in any = Address("0.0.0.0", kDiscoveryPort);
    Check(::bind(socket_.get(), Generic(any), sizeof(any)) == 0, "bind");
    ip_mreq group{};
    group.imr_multiaddr = group_.sin_addr;
    Check(::setsockopt(socket_.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof(group)) == 0,
          "join 239.255.0.1");
  }
  void Send(const std::string& text) {
    Check(::sendto(socket_.get(), text.data(), text.size(), 0, Generic(group_), sizeof(group_)) ==
              static_cast<ssize_t>(text.size()),
          "send");
  }
  // The oldest datagram; "nothing" if none comes within 5 s.
  std::string Receive() {
    pollfd wanted{.fd = socket_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&wanted, 1, 5000) != 1) return "nothing";
    char text[64];
    const ssize_t got = ::recv(socket_.get(), text, sizeof(text), 0);
    Check(got >= 0, "receive");
    return {text, static_cast<std::size_t>(got)};
  }

 private:
  sockaddr_in group_ = Address("239.255.0.1", kDiscoveryPort);
  UniqueFd socket_;
};

// All interfaces of this network, each with its IPv4 address and what of kWanted it has:
// "eth0 192.168.123.99/24 up multicast;".
std::string Interfaces();

class PrivateNetworkTest : public ::testing::TestWithParam<Rights> {
 protected:
  // What `body` returns in a private network.
  static std::string Inside(const std::function<std::string()>& body) {
    return test::InFork([&] {
      Take(GetParam());
      EnterPrivateNetwork();
      return body();
    });
  }

  // What `program` returns at the program's end of a cable. At the other end `robot` does what it
  // does; its argument lets the program begin.
  static std::string OnCable(
      const std::function<std::string()>& program,
      const std::function<void(const std::function<void()>&)>& robot = [](const auto& go) {
        go();
      }) {
    return test::InFork([&] {
      Take(GetParam());
      CabledNetwork network({.interface = "eth0", .address = "192.168.123.99/24"});
      test::Pipe ready;
      test::Forked other([&] {
        Check(network.rights().Apply(), "rights");
        test::ReadLine(ready.out.get());
        return program();
      });
      network.MoveToRobot();
      robot([&] { test::WriteLine(ready.in.get(), "go"); });
      return other.Result();
    });
  }
};

}  // namespace understudy::exec
