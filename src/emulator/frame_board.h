// Where the tick shows itself, if somebody looks.
#ifndef UNDERSTUDY_EMULATOR_FRAME_BOARD_H_
#define UNDERSTUDY_EMULATOR_FRAME_BOARD_H_

#include <atomic>
#include <cstdint>
#include <utility>

#include "emulator/frame.h"

namespace understudy::emulator {

// One frame that goes to and fro between one thread that asks and the one that ticks, whose it is
// by turns: no lock, no copy, nothing to allocate. While nobody asks, the tick reads one flag.
class FrameBoard {
 public:
  explicit FrameBoard(Frame frame) : frame_(std::move(frame)) {}

  // The tick: the frame to be filled as its `parts` say, or null where none is wanted. Show hands
  // it back.
  Frame* Wanted() {
    if (turn_.load(std::memory_order_relaxed) != Turn::kTick) return nullptr;
    return turn_.load(std::memory_order_acquire) == Turn::kTick ? &frame_ : nullptr;
  }
  void Show() { turn_.store(Turn::kShown, std::memory_order_release); }

  // Who asks, and never again before the frame has come and gone.
  void Ask(FrameParts parts) {
    frame_.parts = parts;
    turn_.store(Turn::kTick, std::memory_order_release);
  }
  // The frame that was asked for; null until it is there.
  const Frame* Shown() const {
    return turn_.load(std::memory_order_acquire) == Turn::kShown ? &frame_ : nullptr;
  }
  void Leave() { turn_.store(Turn::kNobody, std::memory_order_relaxed); }

 private:
  enum class Turn : std::uint8_t { kNobody, kTick, kShown };

  std::atomic<Turn> turn_{Turn::kNobody};
  Frame frame_;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_FRAME_BOARD_H_
