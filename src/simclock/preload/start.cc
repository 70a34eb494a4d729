// How a process takes the clock.
#include <csignal>
#include <cstdlib>

#include <link.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "simclock/preload/core.h"

namespace understudy::simclock {

Page* page = nullptr;
bool in_robot = false;
int page_file = -1;

namespace {

// The code of Cyclone DDS in the robot's process.
std::uintptr_t cyclone_begin = 0, cyclone_end = 0;

int FindCode(dl_phdr_info* library, std::size_t, void* function) {
  const auto at = reinterpret_cast<std::uintptr_t>(function);
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& part = library->dlpi_phdr[i];
    const std::uintptr_t begin = library->dlpi_addr + part.p_vaddr;
    if (part.p_type != PT_LOAD || at < begin || at >= begin + part.p_memsz) continue;
    cyclone_begin = begin;
    cyclone_end = begin + part.p_memsz;
    return 1;
  }
  return 0;
}

Slot* child = nullptr;  // of a thread that forks
void BeforeFork() { child = Waiter() != nullptr ? TakeSlot() : nullptr; }
void InParent() { child = nullptr; }
void InChild() { Adopt(child); }

Page* Map(int file) {
  struct stat is {};
  if (::fstat(file, &is) != 0 || is.st_size != sizeof(Page)) return nullptr;
  void* const at = ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (at == MAP_FAILED) return nullptr;
  auto* const mapped = static_cast<Page*>(at);
  return mapped->magic == kMagic && mapped->version == kVersion ? mapped : nullptr;
}

// After exec the first thread has a slot already, that of the process that forked.
void AdoptEarlier() {
  const int pid = getpid();
  Slot* mine = nullptr;
  for (std::uint32_t i = 0; i < page->used; ++i) {
    Slot& slot = page->slots[i];
    if (slot.state == State::kFree || slot.pid != pid) continue;
    if (mine == nullptr && slot.tid == pid) {
      mine = &slot;
    } else {
      FreeSlot(&slot);
    }
  }
  Adopt(mine != nullptr ? mine : TakeSlot());
}

__attribute__((constructor(101))) void Start() {
  const char* const number = std::getenv(kPageVariable);
  if (number == nullptr) return;
  page_file = std::atoi(number);
  page = Map(page_file);
  if (page == nullptr) return;
  MakeSlotKey();
  // Ends waits; it has nothing else to do.
  struct sigaction interrupt {};
  interrupt.sa_handler = [](int) {};
  REAL(sigaction)(page->signal, &interrupt, nullptr);
  in_robot = getpid() == page->robot;
  if (in_robot) {
    page->loaded = 1;
    ::dl_iterate_phdr(&FindCode, ::dlsym(RTLD_DEFAULT, "dds_create_participant"));
    return;
  }
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, page->signal);
  REAL(pthread_sigmask)(SIG_UNBLOCK, &ours, nullptr);
  AdoptCore();
  AdoptEarlier();
  pthread_atfork(&BeforeFork, &InParent, &InChild);
  std::int32_t none = 0;
  page->program.compare_exchange_strong(none, getpid());
}

}  // namespace

bool OnClock(const void* caller) {
  if (page == nullptr) return false;
  if (!in_robot) return !TimeStands();
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  return at >= cyclone_begin && at < cyclone_end;
}

}  // namespace understudy::simclock
