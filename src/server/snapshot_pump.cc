#include "server/snapshot_pump.h"

#include <algorithm>

#include "server/snapshot_json.h"

namespace understudy::server {
std::shared_ptr<const std::string> ShownSnapshot::Json(emulator::SnapshotParts parts) {
  for (const auto& [made_of, text] : texts_) {
    if (made_of == parts) return text;
  }
  return texts_
      .emplace_back(parts, std::make_shared<const std::string>(SnapshotJson(snapshot_, parts)))
      .second;
}

SnapshotPump::SnapshotPump(boost::asio::io_context* io, emulator::SnapshotMailbox* mailbox)
    : mailbox_(mailbox), observer_(mailbox->Join()), rung_(*io, observer_->bell().fd()) {}

void SnapshotPump::Ask(emulator::SnapshotParts parts, const std::shared_ptr<SnapshotTaker>& taker) {
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return waiting.taker.expired() || waiting.taker.lock() == taker;
  });
  waiting_.push_back({.parts = parts, .taker = taker});
  if (!asked_) Request();
}

void SnapshotPump::Request() {
  emulator::SnapshotParts parts = 0;
  for (const Waiting& waiting : waiting_) parts |= waiting.parts;
  observer_->Ask(parts);
  asked_ = true;
  Wait();
}

void SnapshotPump::Wait() {
  rung_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                   [this](const boost::system::error_code& error) {
                     if (error) return;
                     if (!observer_->bell().Answer()) return Wait();
                     Deliver(*mailbox_->Newest());
                   });
}

// A later request for parts that this snapshot lacks waits for the next one.
void SnapshotPump::Deliver(const emulator::Snapshot& snapshot) {
  const auto served = std::partition(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return (waiting.parts & ~snapshot.parts) != 0;
  });
  const std::vector<Waiting> now(served, waiting_.end());
  waiting_.erase(served, waiting_.end());
  ShownSnapshot shown(snapshot);
  for (const Waiting& waiting : now) {
    if (const auto taker = waiting.taker.lock()) taker->OnSnapshot(&shown);
  }
  asked_ = false;
  if (!waiting_.empty()) Request();
}

}  // namespace understudy::server
