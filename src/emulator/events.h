// Events of a robot as values: appended once, by the thread of the tick, and read by any number of
// other threads.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>

#include "emulator/request.h"

namespace understudy::emulator {

// Each has a row in the table of event_table.cc, in this order.
enum class EventKind : std::uint8_t {
  kRefused,
  kTolerated,
  kLostCommands,
  kUnmatched,
  kUnserved,
  kTimeout,
  kFollowing,
  kFirstCommand,
  kUnheld,
  kGate,
  kMotionService,
  kMotion,
  kUnheeded,
  kRemote,
  kRequest,
  kCrane,
  kClamp,
  kSetting,
  kFault,
  kMotorHeat,
  kPower,
  kCutOff,
  kLowBattery,
  kProtection,
  kPause,
  kSpeed,
  kScript,
  kScriptRefused,
  kScriptWait,
  kDivergence,
  kSilence,
  kWriters,
  kUnusedSlot,
  kUnsetHead,
  kWriteFailure,
  kOverrun,
  kStall,
  kCall,
  kCallRefused,
  kProgramStart,
  kProgramEnd,
  kProgramPrints,
  kRecording,
  kRecordingFailed,
  kLost,
  kCount,
};

inline constexpr std::size_t kEventKinds = static_cast<std::size_t>(EventKind::kCount);

// The row of the kind gives numbers and text their meaning. Only a kRequest has a request.
struct Event {
  std::int64_t step = 0;  // the step being made, or the next one
  double time = 0;        // simulated s, of that step
  EventKind kind = EventKind::kCount;
  std::uint8_t robot = 0;  // its number in the world
  std::array<double, 4> numbers{};
  std::array<char, 120> text{};  // cut to fit, with a zero at its end
  Request request{};
};

// Names that a kUnheld has, of however many joints.
inline constexpr std::size_t kMostNamed = 3;

// Returns `text` as Event::text has it.
template <std::size_t kRoom>
void CopyText(std::string_view text, std::array<char, kRoom>* to) {
  *to = {};
  text.copy(to->data(), kRoom - 1);
}

// A ring of events with one writer, which never waits, and any number of readers. The oldest events
// are overwritten; a reader that was too slow learns how many it has lost.
class EventRing {
 public:
  static constexpr std::size_t kCapacity = 2048;  // *assumed*: seconds of one refusal per tick

  // For the writer: sets the step of the events added from now on.
  void SetStep(std::int64_t step, double time) {
    step_ = step;
    time_ = time;
  }
  // For the writer: appends an event. `robot` is its number in the world. Allocates nothing.
  void Add(EventKind kind, std::uint8_t robot = 0, const std::array<double, 4>& numbers = {},
           std::string_view text = {}) {
    Event event{.step = step_, .time = time_, .kind = kind, .robot = robot, .numbers = numbers};
    CopyText(text, &event.text);
    Append(event);
  }
  void Append(const Event& event) {
    const std::uint64_t number = written_.load(std::memory_order_relaxed);
    begun_.store(number + 1, std::memory_order_relaxed);
    // A reader of one of these words sees that its slot is being overwritten.
    Words& slot = slots_[number % kCapacity];
    Words words;
    std::memcpy(words.data(), &event, sizeof event);
    for (std::size_t i = 0; i < words.size(); ++i) {
      std::atomic_ref(slot[i]).store(words[i], std::memory_order_release);
    }
    written_.store(number + 1, std::memory_order_release);
  }

  // Returns how many events were appended since the start. Any thread.
  std::uint64_t count() const { return written_.load(std::memory_order_acquire); }

  // The position of one reader. The ring must outlive it.
  class Reader {
   public:
    // Begins at the oldest event in the ring.
    explicit Reader(const EventRing* ring) : ring_(ring) {}

    // Reads the next event and returns true, or false if there is none yet. Lost events are
    // reported as one event kLost.
    bool Next(Event* event) {
      while (true) {
        const std::uint64_t written = ring_->count();
        if (next_ == written) return false;
        const std::uint64_t oldest = written < kCapacity ? 0 : written - kCapacity;
        if (next_ < oldest) lost_ += oldest - next_;
        next_ = next_ < oldest ? oldest : next_;
        if (!ring_->Copy(next_, event)) continue;
        if (lost_ == 0) {
          ++next_;
          return true;
        }
        *event = {.step = event->step,
                  .time = event->time,
                  .kind = EventKind::kLost,
                  .robot = event->robot,
                  .numbers = {static_cast<double>(lost_)}};
        lost_ = 0;
        return true;
      }
    }

   private:
    const EventRing* ring_;
    std::uint64_t next_ = 0;
    std::uint64_t lost_ = 0;
  };

 private:
  using Words = std::array<std::uint64_t, sizeof(Event) / sizeof(std::uint64_t)>;
  static_assert(sizeof(Words) == sizeof(Event) && std::is_trivially_copyable_v<Event>);

  // Returns false if the event was overwritten meanwhile.
  bool Copy(std::uint64_t number, Event* event) const {
    Words& slot = slots_[number % kCapacity];
    Words words;
    for (std::size_t i = 0; i < words.size(); ++i) {
      words[i] = std::atomic_ref(slot[i]).load(std::memory_order_acquire);
    }
    if (begun_.load(std::memory_order_relaxed) > number + kCapacity) return false;
    std::memcpy(static_cast<void*>(event), words.data(), sizeof *event);
    return true;
  }

  std::int64_t step_ = 0;
  double time_ = 0;
  // Takes memory where events have been written.
  std::unique_ptr<Words[]> slots_ = std::make_unique_for_overwrite<Words[]>(kCapacity);
  std::atomic<std::uint64_t> begun_{0};
  std::atomic<std::uint64_t> written_{0};
};
}  // namespace understudy::emulator
