// The base of the server's connections, the list of them, and what they share. Sees Boost; for the
// server's own files only.
#pragma once

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

// A Unix socket or TCP, which are alike from here on.
using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol>;

// One client. Pending operations hold a shared pointer to it, and so does its list until it
// finishes.
class Connection : public FrameTaker, public std::enable_shared_from_this<Connection> {
 public:
  virtual void Begin() = 0;
};

// The connections of one listening socket.
class Connections {
 public:
  // `access`: null if every client may do everything. `most`: how many connections at once.
  Connections(const Access* access, std::size_t most) : access_(access), most_(most) {}

  const Access* access() const { return access_; }
  bool full() const { return open_.size() >= most_; }

  void Add(std::shared_ptr<Connection> connection) {
    Connection* const key = connection.get();
    open_.emplace(key, std::move(connection));
    key->Begin();
  }
  void Remove(Connection* connection) { open_.erase(connection); }

 private:
  const Access* access_;
  std::size_t most_;
  std::unordered_map<Connection*, std::shared_ptr<Connection>> open_;
};

// How often the server looks for new events; *assumed*, as quick as an eye.
inline constexpr std::chrono::milliseconds kEventsEvery{50};

// What all connections of a server share. Outlives them.
struct Shared {
  Plane plane;
  ServerLimits limits;
  FramePump* pump = nullptr;
  RequestDesk* desk = nullptr;
};

}  // namespace understudy::server
