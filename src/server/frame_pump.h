// Gets frames from the tick for those connections that want one. Sees Boost; for the server's own
// files only.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "emulator/snapshot_mailbox.h"

namespace understudy::server {

// A frame that has come, and its texts, each made once for all who send it.
class ShownFrame {
 public:
  explicit ShownFrame(const emulator::Frame& frame) : frame_(frame) {}

  const emulator::Frame& frame() const { return frame_; }
  std::shared_ptr<const std::string> Json(emulator::FrameParts parts);

 private:
  const emulator::Frame& frame_;
  std::vector<std::pair<emulator::FrameParts, std::shared_ptr<const std::string>>> texts_;
};

class FrameTaker {
 public:
  FrameTaker() = default;
  virtual ~FrameTaker() = default;
  FrameTaker(const FrameTaker&) = delete;
  FrameTaker& operator=(const FrameTaker&) = delete;

  // The frame that was asked for, with those parts at least.
  virtual void OnFrame(ShownFrame* shown) = 0;
};

// However many ask, the tick fills in one frame at a time. Of the server's thread.
class FramePump {
 public:
  FramePump(boost::asio::io_context* io, emulator::SnapshotMailbox* mailbox);
  ~FramePump() { rung_.release(); }  // the bell's own

  // OnFrame is called once, unless the taker goes before. One that asks again before that waits for
  // one frame still.
  void Ask(emulator::FrameParts parts, const std::shared_ptr<FrameTaker>& taker);

 private:
  struct Waiting {
    emulator::FrameParts parts;
    std::weak_ptr<FrameTaker> taker;
  };

  void Request();
  void Wait();
  void Deliver(const emulator::Frame& frame);

  emulator::SnapshotMailbox* mailbox_;
  emulator::SnapshotMailbox::Observer* observer_;
  boost::asio::posix::stream_descriptor rung_;
  std::vector<Waiting> waiting_;
  bool asked_ = false;
};

}  // namespace understudy::server
