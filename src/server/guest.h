// What every connection of the server is, and what they share. Sees Boost; for the server's own
// files only.
#ifndef UNDERSTUDY_SERVER_GUEST_H_
#define UNDERSTUDY_SERVER_GUEST_H_

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/beast/core.hpp>

#include "server/access.h"
#include "server/frame_pump.h"
#include "server/plane.h"
#include "server/server.h"

namespace understudy::server {

class RequestDesk;

// Of a Unix socket or TCP: the same from here on.
using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol>;

// One client. Whatever is under way holds it by a shared pointer, its door by another until it is
// done.
class Guest : public FrameTaker, public std::enable_shared_from_this<Guest> {
 public:
  virtual void Begin() = 0;
};

// The connections that came in at one place.
class Door {
 public:
  // `access`: null where everybody who gets in may do everything.
  Door(const Access* access, std::size_t most) : access_(access), most_(most) {}

  const Access* access() const { return access_; }
  bool full() const { return connections_.size() >= most_; }

  void Admit(std::shared_ptr<Guest> connection) {
    Guest* const key = connection.get();
    connections_.emplace(key, std::move(connection));
    key->Begin();
  }
  void Dismiss(Guest* connection) { connections_.erase(connection); }

 private:
  const Access* access_;
  std::size_t most_;
  std::unordered_map<Guest*, std::shared_ptr<Guest>> connections_;
};

// How often the server looks what has happened; *assumed*, as quick as an eye.
inline constexpr std::chrono::milliseconds kEventsEvery{50};

// What all connections of a server share. Outlives them.
struct Shared {
  Plane plane;
  ServerLimits limits;
  FramePump* pump = nullptr;
  RequestDesk* desk = nullptr;
};

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_GUEST_H_
