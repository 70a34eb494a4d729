// Opens the TCP socket of the panel.
#pragma once

#include <string>

namespace understudy::server {

inline constexpr int kFirstPanelPort = 7707;  // of domain 0; *assumed*: free on most machines
inline constexpr int kPanelPorts = 256;       // ports to try; after them any free port is used

// Listens from construction to destruction, in the network namespace in which it was made.
class PanelSocket {
 public:
  // With `port` 0 takes kFirstPanelPort + `domain`, or the next free port above it. Makes a new
  // token. Throws ConfigError for an invalid address, SocketError if address or port cannot be
  // used.
  PanelSocket(const std::string& address, int port, int domain = 0);
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
  // Returns the panel's URL with the token, "http://127.0.0.1:7707/#token=...".
  std::string url() const { return "http://" + host() + "/#token=" + token_; }

 private:
  std::string address_;
  std::string token_;
  int family_ = 0;
  int port_ = 0;
  int fd_ = -1;
};

}  // namespace understudy::server
