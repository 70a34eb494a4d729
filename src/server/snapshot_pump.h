// Gets snapshots from the tick for the connections that request one. Includes Boost; private to
// server/.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "emulator/snapshot_mailbox.h"

namespace understudy::server {

// A posted snapshot and its texts, each made once for all connections.
class ShownSnapshot {
 public:
  explicit ShownSnapshot(const emulator::Snapshot& snapshot) : snapshot_(snapshot) {}

  const emulator::Snapshot& snapshot() const { return snapshot_; }
  std::shared_ptr<const std::string> Json(emulator::SnapshotParts parts);

 private:
  const emulator::Snapshot& snapshot_;
  std::vector<std::pair<emulator::SnapshotParts, std::shared_ptr<const std::string>>> texts_;
};

class SnapshotTaker {
 public:
  SnapshotTaker() = default;
  virtual ~SnapshotTaker() = default;
  SnapshotTaker(const SnapshotTaker&) = delete;
  SnapshotTaker& operator=(const SnapshotTaker&) = delete;

  // Receives the requested snapshot, with at least those parts.
  virtual void OnSnapshot(ShownSnapshot* shown) = 0;
};

// Requests one snapshot at a time from the tick, for all connections. Used by the server's thread.
class SnapshotPump {
 public:
  SnapshotPump(boost::asio::io_context* io, emulator::SnapshotMailbox* mailbox);
  ~SnapshotPump() { rung_.release(); }  // the bell's own

  // Calls OnSnapshot of the taker once, unless it is destroyed before. A taker that asks again
  // before that still gets one snapshot.
  void Ask(emulator::SnapshotParts parts, const std::shared_ptr<SnapshotTaker>& taker);

 private:
  struct Waiting {
    emulator::SnapshotParts parts;
    std::weak_ptr<SnapshotTaker> taker;
  };

  void Request();
  void Wait();
  void Deliver(const emulator::Snapshot& snapshot);

  emulator::SnapshotMailbox* mailbox_;
  emulator::SnapshotMailbox::Observer* observer_;
  boost::asio::posix::stream_descriptor rung_;
  std::vector<Waiting> waiting_;
  bool asked_ = false;
};

}  // namespace understudy::server
