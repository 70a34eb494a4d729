// Opens the TCP socket of the panel.
#pragma once

#include <string>

namespace understudy::server {

inline constexpr int kFirstPanelPort = 7707;  // *assumed*: free on most machines
inline constexpr int kPanelPorts = 256;       // ports to try; after them any free port is used

// An address that a panel had: its port, and the token that writing needs.
struct PanelPlace {
  int port = 0;       // 0: none
  std::string token;  // "": none
};

// Listens from construction to destruction, in the network namespace in which it was made.
class PanelSocket {
 public:
  // With `port` 0 takes that of `before` if it is free, else the first free one from
  // kFirstPanelPort up. The token is that of `before`, or a new one. Throws ConfigError for an
  // invalid address, SocketError if address or port cannot be used.
  PanelSocket(const std::string& address, int port, const PanelPlace& before = {});
  ~PanelSocket();
  PanelSocket(const PanelSocket&) = delete;
  PanelSocket& operator=(const PanelSocket&) = delete;

  int fd() const { return fd_; }
  int family() const { return family_; }                   // AF_INET or AF_INET6
  const std::string& address() const { return address_; }  // as inet_ntop writes it
  int port() const { return port_; }
  const std::string& token() const { return token_; }
  // Returns the host of the panel's URL on this machine: "127.0.0.1:7707", "[::1]:7707".
  std::string host() const;

 private:
  std::string address_;
  std::string token_;
  int family_ = 0;
  int port_ = 0;
  int fd_ = -1;
};

}  // namespace understudy::server
