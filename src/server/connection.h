// The base class of the server's connections, their list, and shared objects. Includes Boost;
// private to server/.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/beast/core.hpp>

#include "server/access.h"
#include "server/plane.h"
#include "server/server.h"
#include "server/snapshot_pump.h"

namespace understudy::server {

class RequestDesk;
class ViewDesk;

// A Unix or TCP socket.
using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol>;

// One client. Pending operations own it by a shared pointer, and so does the list until it
// finishes.
class Connection : public SnapshotTaker, public std::enable_shared_from_this<Connection> {
 public:
  virtual void Begin() = 0;
  // Ends what waits for the client; its place is another's.
  virtual void GiveWay() {}
};

// The connections of one listening socket.
class Connections {
 public:
  // `access` is null if every client may do everything. `most` is the highest number of
  // connections.
  Connections(const AccessRules* access, std::size_t most) : access_(access), most_(most) {}

  const AccessRules* access() const { return access_; }
  // Returns whether there is a place for one more. If all are taken, the one for whose client we
  // have waited longest loses its own.
  bool MakeRoom() {
    if (open_.size() >= most_ && !waiting_.empty()) {
      const std::shared_ptr<Connection> oldest = open_.at(waiting_.front());
      Remove(oldest.get());
      oldest->GiveWay();
    }
    return open_.size() < most_;
  }
  // `connection` waits for its client from now on.
  void Wait(Connection* connection) {
    Work(connection);
    if (open_.contains(connection)) waiting_.push_back(connection);
  }
  // `connection` waits for its client no longer.
  void Work(Connection* connection) { std::erase(waiting_, connection); }
  // Whether the rest of the places is for clients with the token, and for short requests.
  bool crowded() const { return strangers_.size() >= most_ - most_ / 4; }

  void Add(std::shared_ptr<Connection> connection) {
    Connection* const key = connection.get();
    open_.emplace(key, std::move(connection));
    key->Begin();
  }
  // A WebSocket that has not shown the token.
  void AddStranger(std::shared_ptr<Connection> connection) {
    strangers_.insert(connection.get());
    Add(std::move(connection));
  }
  void Remove(Connection* connection) {
    Work(connection);
    strangers_.erase(connection);
    open_.erase(connection);
  }

 private:
  const AccessRules* access_;
  std::size_t most_;
  std::unordered_map<Connection*, std::shared_ptr<Connection>> open_;
  std::unordered_set<Connection*> strangers_;  // of `open_`
  std::vector<Connection*> waiting_;           // of `open_`, the longest wait first
};

// How often the server looks for new events; *assumed*: faster than visible.
inline constexpr std::chrono::milliseconds kEventsEvery{50};

// Objects that all connections of a server share. Must outlive them.
struct Shared {
  Plane plane;
  ServerLimits limits;
  SnapshotPump* pump = nullptr;
  RequestDesk* desk = nullptr;
  ViewDesk* views = nullptr;
};

}  // namespace understudy::server
