#include "server/frame_pump.h"

#include <algorithm>

#include "server/frame_json.h"

namespace understudy::server {
namespace {

// How often the board is looked at while a frame is awaited: about as often as the tick comes by.
constexpr std::chrono::milliseconds kLook{1};

}  // namespace

std::shared_ptr<const std::string> ShownFrame::Json(emulator::FrameParts parts) {
  for (const auto& [made_of, text] : texts_) {
    if (made_of == parts) return text;
  }
  return texts_.emplace_back(parts, std::make_shared<const std::string>(FrameJson(frame_, parts)))
      .second;
}

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
  board_->Ask(parts);
  asked_ = true;
  Wait();
}

void FramePump::Wait() {
  timer_.expires_after(kLook);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) return;
    const emulator::Frame* frame = board_->Shown();
    if (frame == nullptr) return Wait();
    Deliver(*frame);
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
  board_->Leave();
  asked_ = false;
  if (!waiting_.empty()) Request();
}

}  // namespace understudy::server
