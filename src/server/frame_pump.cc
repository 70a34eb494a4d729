#include "server/frame_pump.h"

#include <algorithm>

#include "server/frame_json.h"

namespace understudy::server {
std::shared_ptr<const std::string> ShownFrame::Json(emulator::FrameParts parts) {
  for (const auto& [made_of, text] : texts_) {
    if (made_of == parts) return text;
  }
  return texts_.emplace_back(parts, std::make_shared<const std::string>(FrameJson(frame_, parts)))
      .second;
}

FramePump::FramePump(boost::asio::io_context* io, emulator::SnapshotMailbox* mailbox)
    : mailbox_(mailbox), observer_(mailbox->Join()), rung_(*io, observer_->bell().fd()) {}

void FramePump::Ask(emulator::FrameParts parts, const std::shared_ptr<FrameTaker>& taker) {
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return waiting.taker.expired() || waiting.taker.lock() == taker;
  });
  waiting_.push_back({.parts = parts, .taker = taker});
  if (!asked_) Request();
}

void FramePump::Request() {
  emulator::FrameParts parts = 0;
  for (const Waiting& waiting : waiting_) parts |= waiting.parts;
  observer_->Ask(parts);
  asked_ = true;
  Wait();
}

void FramePump::Wait() {
  rung_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                   [this](const boost::system::error_code& error) {
                     if (error) return;
                     if (!observer_->bell().Answer()) return Wait();
                     Deliver(*mailbox_->Newest());
                   });
}

// Who came later and wants more than this frame has waits for the next.
void FramePump::Deliver(const emulator::Frame& frame) {
  const auto served = std::partition(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return (waiting.parts & ~frame.parts) != 0;
  });
  const std::vector<Waiting> now(served, waiting_.end());
  waiting_.erase(served, waiting_.end());
  ShownFrame shown(frame);
  for (const Waiting& waiting : now) {
    if (const auto taker = waiting.taker.lock()) taker->OnFrame(&shown);
  }
  asked_ = false;
  if (!waiting_.empty()) Request();
}

}  // namespace understudy::server
