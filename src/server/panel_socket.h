// The TCP socket of the panel.
#pragma once

#include <string>

namespace understudy::server {

inline constexpr int kFirstPanelPort = 7707;  // *assumed*: free on most machines
inline constexpr int kPanelPorts = 256;       // robots side by side, after which any port will do

// Listens from construction to destruction, in the network namespace in which it was made.
class PanelSocket {
 public:
  // `port` 0: the first that is free from kFirstPanelPort on. Throws ConfigError when the address
  // is none, SocketError when it is not to be had.
  PanelSocket(const std::string& address, int port);
  ~PanelSocket();
  PanelSocket(const PanelSocket&) = delete;
  PanelSocket& operator=(const PanelSocket&) = delete;

  int fd() const { return fd_; }
  int family() const { return family_; }                   // AF_INET or AF_INET6
  const std::string& address() const { return address_; }  // as inet_ntop writes it
  int port() const { return port_; }
  // "127.0.0.1:7707", "[::1]:7707": what a browser on this machine is told.
  std::string host() const;

 private:
  std::string address_;
  int family_ = 0;
  int port_ = 0;
  int fd_ = -1;
};

}  // namespace understudy::server
