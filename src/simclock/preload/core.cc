#include "simclock/preload/core.h"

#include <cstring>

#include <linux/futex.h>
#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace understudy::simclock {
namespace {

constexpr int kMostReads = 1000;  // at one instant; *assumed*
// What they then cost [ns], or an eighth of how long the thread reads already; all *assumed*.
constexpr std::int64_t kSpin = 20'000, kMostSpin = 500'000;

// `initial-exec`: no allocation at the first use.
#define OWN thread_local __attribute__((tls_model("initial-exec")))
OWN Slot* self = nullptr;
OWN std::int64_t last_read = 0;
OWN std::int64_t spins_since = -1;
OWN int reads = 0;
OWN bool slept = false;        // and has sent nothing since
OWN std::int64_t woke_at = 0;  // the processor's time of this thread then [ns]
OWN bool collects = false;
OWN bool stands = false;
#undef OWN

pthread_key_t key;  // frees the slot of a thread that ends
// What it takes to start a process that asks the robot [ns]; *assumed*, of a computer with time.
constexpr std::int64_t kAsking = 10'000'000;
constexpr int kAboveCoordinator = 2;  // real-time priority; the coordinator has 1

// Of this thread [ns].
std::int64_t ProcessorTime() {
  timespec time{};
  REAL(clock_gettime)(CLOCK_THREAD_CPUTIME_ID, &time);
  return Ns(time);
}

void RingIfQuiet(std::int32_t running) {
  if (running > page->loose.load() || page->listening.load() == 0) return;
  page->bell.fetch_add(1);
  Futex(&page->bell, FUTEX_WAKE, 1);
}

}  // namespace

long Futex(void* word, int operation, std::uint32_t value, const timespec* timeout,
           std::uint32_t mask) {
#if defined(__x86_64__)
  long result;
  register long r10 __asm__("r10") = reinterpret_cast<long>(timeout);
  register long r8 __asm__("r8") = 0;
  register long r9 __asm__("r9") = mask;
  __asm__ volatile("syscall"
                   : "=a"(result)
                   : "a"(SYS_futex), "D"(word), "S"(static_cast<long>(operation)),
                     "d"(static_cast<unsigned long>(value)), "r"(r10), "r"(r8), "r"(r9)
                   : "rcx", "r11", "memory");
  return result;
#elif defined(__aarch64__)
  register long x8 __asm__("x8") = SYS_futex;
  register long x0 __asm__("x0") = reinterpret_cast<long>(word);
  register long x1 __asm__("x1") = operation;
  register long x2 __asm__("x2") = value;
  register long x3 __asm__("x3") = reinterpret_cast<long>(timeout);
  register long x4 __asm__("x4") = 0;
  register long x5 __asm__("x5") = mask;
  __asm__ volatile("svc 0"
                   : "+r"(x0)
                   : "r"(x8), "r"(x1), "r"(x2), "r"(x3), "r"(x4), "r"(x5)
                   : "memory");
  return x0;
#else
#error "no system calls of this architecture"
#endif
}

std::int32_t ThreadId() { return gettid(); }

// ---- slots

Slot* TakeSlot() {
  for (std::uint32_t i = 0; i < kMostThreads; ++i) {
    Slot& slot = page->slots[i];
    State free = State::kFree;
    if (slot.state.load(std::memory_order_relaxed) != State::kFree) continue;
    if (!slot.state.compare_exchange_strong(free, State::kRunning)) continue;
    slot.pid = 0;
    slot.tid = 0;
    slot.deadline = kNever;
    slot.kind = Kind::kEvent;
    slot.what = {};
    page->running.fetch_add(1);
    std::uint32_t used = page->used;
    while (used < i + 1 && !page->used.compare_exchange_weak(used, i + 1)) {
    }
    return &slot;
  }
  page->refused.fetch_add(1);
  return nullptr;
}

void FreeSlot(Slot* slot) {
  if (slot == nullptr) return;
  if (slot->state.exchange(State::kFree) != State::kBlocked) {
    RingIfQuiet(page->running.fetch_sub(1) - 1);
  }
}

void Collect() { collects = true; }

void MakeSlotKey() {
  pthread_key_create(&key, [](void* mine) {
    self = nullptr;
    auto* const slot = static_cast<Slot*>(mine);
    // A thread of a program is gone, and who joins it wakes, a little later: the coordinator frees
    // its slot then, so that no time passes in between.
    if (in_robot || slot->tid == slot->pid) FreeSlot(slot);
  });
}

void Adopt(Slot* slot) {
  self = slot;
  if (slot == nullptr) return;
  slot->pid = getpid();
  slot->tid = ThreadId();
  pthread_setspecific(key, slot);
}

void LeaveClock() {
  pthread_setspecific(key, nullptr);
  FreeSlot(self);
  self = nullptr;
}

void AdoptCore() {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(page->core), &set);
  REAL(sched_setaffinity)(0, sizeof(set), &set);
  // Without the right the coordinator has to look who sleeps.
  if (!TakePriority()) page->fifo = 0;
}

bool TakePriority() {
  if (page->fifo == 0) return true;
  const sched_param above{.sched_priority = kAboveCoordinator};
  return REAL(sched_setscheduler)(0, SCHED_FIFO, &above) == 0;
}

void LeavePriority() {
  const sched_param usual{};
  REAL(sched_setscheduler)(0, SCHED_OTHER, &usual);
}

bool TimeStands() { return stands; }

Slot* Waiter() {
  if (stands) return nullptr;
  if (self == nullptr && !in_robot) Adopt(TakeSlot());
  return self;
}

void Block(const char* what, Kind kind, std::int64_t deadline) {
  Slot* const slot = self;
  reads = 0;
  spins_since = -1;
  std::strncpy(slot->what.data(), what, slot->what.size() - 1);
  slot->kind.store(kind, std::memory_order_relaxed);
  slot->deadline.store(deadline, std::memory_order_relaxed);
  slot->blocks.fetch_add(1, std::memory_order_relaxed);
  slot->state.store(State::kBlocked);
  RingIfQuiet(page->running.fetch_sub(1) - 1);
}

bool Unblock() {
  // The coordinator has counted one that it fired as running.
  const State before = self->state.exchange(State::kRunning);
  if (before == State::kBlocked) page->running.fetch_add(1);
  self->deadline.store(kNever, std::memory_order_relaxed);
  return before == State::kFired;
}

// ---- time

std::int64_t Now() { return page->now.load(std::memory_order_acquire); }

std::int64_t Read(int weight) {
  const std::int64_t now = Now();
  if (now != last_read) {
    last_read = now;
    reads = 0;
    return now;
  }
  if (in_robot || (reads += weight) <= kMostReads || Waiter() == nullptr) return now;
  page->spins.fetch_add(1, std::memory_order_relaxed);
  const std::int64_t since = spins_since < 0 ? now : spins_since;
  std::int64_t cost = (now - since) / 8;
  cost = cost < kSpin ? kSpin : cost > kMostSpin ? kMostSpin : cost;
  SleepThrough(now + cost, "spin");
  spins_since = since;
  return last_read = Now();
}

bool IsDate(clockid_t clock) {
  return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE || clock == CLOCK_TAI;
}
bool IsSimulated(clockid_t clock) {
  return IsDate(clock) || clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_RAW ||
         clock == CLOCK_MONOTONIC_COARSE || clock == CLOCK_BOOTTIME;
}

// ---- waits

// The collector sleeps until all others wait, however short. Whether they do when it looks first
// is chance, without a core to themselves.
int SleepUntil(std::int64_t deadline, const char* what, Kind kind) {
  if (Now() >= deadline) return 0;
  if (collects) deadline = Now() + 1;
  const std::uint32_t word = self->wake.load();
  Block(what, kind, deadline);
  while (self->state.load() == State::kBlocked) {
    if (Futex(&self->wake, FUTEX_WAIT, word) == -EINTR) break;
  }
  return Unblock() ? 0 : EINTR;
}

void SleepThrough(std::int64_t deadline, const char* what) {
  while (SleepUntil(deadline, what) == EINTR) {
  }
}

int FutexWait(void* word, std::uint32_t value, std::uint32_t mask, bool is_private,
              std::int64_t deadline, const char* what) {
  if (deadline <= Now()) {
    return static_cast<std::atomic<std::uint32_t>*>(word)->load() == value ? ETIMEDOUT : EAGAIN;
  }
  Block(what, Kind::kEvent, deadline);
  const long error =
      Futex(word, FUTEX_WAIT_BITSET | (is_private ? FUTEX_PRIVATE_FLAG : 0), value, nullptr, mask);
  return Unblock() && error == -EINTR ? ETIMEDOUT : static_cast<int>(-error);
}

void BeginThinking() {
  slept = true;
  woke_at = ProcessorTime();
}

void Think() {
  if (page == nullptr || !slept || in_robot || Waiter() == nullptr) return;
  slept = false;
  page->computed[SpanOf(ProcessorTime() - woke_at)].fetch_add(1, std::memory_order_relaxed);
  if (page->think > 0) SleepThrough(Now() + page->think, "think");
}

}  // namespace understudy::simclock

// For code of Understudy in a program: while `stand`, this thread is on real time, and simulated
// time stands, also where the thread waits. It costs a little before, lest a loop asks for ever.
SIMCLOCK_EXPORT void simclock_stand(bool stand) {
  using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)
  if (stand == stands || page == nullptr || in_robot) return;
  if (stand && Waiter() == nullptr) return;
  if (stand) SleepUntil(Now() + kAsking, "ask", Kind::kAsks);
  self->kind = stand ? Kind::kStands : Kind::kEvent;
  stands = stand;
}
