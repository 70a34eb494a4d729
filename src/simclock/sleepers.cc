#include "simclock/sleepers.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace understudy::simclock {
namespace {

std::string TaskFile(int pid, int tid, const char* name) {
  return "/proc/" + std::to_string(pid) + "/task/" + std::to_string(tid) + "/" + name;
}

// The start of a file, "" of a process that is gone.
std::string Read(const std::string& file) {
  const UniqueFd in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 1024> text{};
  const ssize_t size = in.valid() ? ::read(in.get(), text.data(), text.size()) : 0;
  return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

// Functions of the kernel in which a thread sleeps until the disk, memory or its own making is done
// (Linux 5.10 to 6.18).
bool IsWork(std::string_view function) {
  constexpr std::string_view kWork[] = {
      "folio", "io_schedule", "wait_on_page", "blk_",  "rq_qos", "jbd2",  "ext4",        "xfs_",
      "btrfs", "filemap",     "rwsem",        "mmap_", "exit",   "vfork", "kernel_clone"};
  return std::ranges::any_of(
      kWork, [&](std::string_view one) { return function.find(one) != std::string_view::npos; });
}

struct Call {
  long number;
  const char* name;
};

// System calls that wait for somebody.
constexpr Call kWaitingCalls[] = {
#ifdef SYS_poll
    {SYS_poll, "poll"},
    {SYS_select, "select"},
    {SYS_epoll_wait, "epoll_wait"},
    {SYS_pause, "pause"},
#endif
    {SYS_futex, "futex"},
    {SYS_read, "read"},
    {SYS_readv, "readv"},
    {SYS_ppoll, "ppoll"},
    {SYS_pselect6, "pselect6"},
    {SYS_epoll_pwait, "epoll_pwait"},
    {SYS_epoll_pwait2, "epoll_pwait2"},
    {SYS_recvfrom, "recvfrom"},
    {SYS_recvmsg, "recvmsg"},
    {SYS_recvmmsg, "recvmmsg"},
    {SYS_accept, "accept"},
    {SYS_accept4, "accept4"},
    {SYS_connect, "connect"},
    {SYS_wait4, "wait4"},
    {SYS_waitid, "waitid"},
    {SYS_rt_sigsuspend, "rt_sigsuspend"},
    {SYS_rt_sigtimedwait, "rt_sigtimedwait"},
    {SYS_nanosleep, "nanosleep"},
    {SYS_clock_nanosleep, "clock_nanosleep"},
    {SYS_flock, "flock"},
    {SYS_restart_syscall, "restart_syscall"},
    {SYS_futex_waitv, "futex_waitv"},
    {SYS_mq_timedreceive, "mq_timedreceive"},
    {SYS_mq_timedsend, "mq_timedsend"}};

// The call in which a thread is; -1 if it is in none, or the kernel does not tell.
long CallNumber(int pid, int tid) {
  const std::string text = Read(TaskFile(pid, tid, "syscall"));
  const bool is_number = !text.empty() && text[0] >= '0' && text[0] <= '9';
  return is_number ? std::strtol(text.c_str(), nullptr, 10) : -1;
}

bool InWaitingCall(int pid, int tid) {
  const long number = CallNumber(pid, tid);
  return std::ranges::find(kWaitingCalls, number, &Call::number) != std::end(kWaitingCalls);
}

bool IsZombie(int pid, int tid) {
  const std::string text = Read(TaskFile(pid, tid, "stat"));
  const std::size_t end = text.rfind(')');
  return end == std::string::npos || text.find_first_of("ZX", end) == end + 2;
}

}  // namespace

// wchan is "0" while the thread runs, is to run or is being woken, else the kernel's function in
// which it sleeps. `syscall`, beside it, takes one that is being woken on another core for asleep.
Sleep Sleepers::Look(std::uint32_t index) {
  const Slot& slot = page_.slots[index];
  const int pid = slot.pid, tid = slot.tid;
  if (pid == 0 || tid == 0) return Sleep::kAwake;
  File& file = files_[index];
  if (!file.wchan.valid() || file.tid != tid) {
    file.wchan = UniqueFd(::open(TaskFile(pid, tid, "wchan").c_str(), O_RDONLY | O_CLOEXEC));
    file.tid = tid;
    if (!file.wchan.valid()) return errno == ENOENT ? Sleep::kGone : Sleep::kAwake;
  }
  std::array<char, 128> text{};
  const ssize_t size = ::pread(file.wchan.get(), text.data(), text.size() - 1, 0);
  if (size <= 0) {
    if (size < 0 && errno != ESRCH) return Sleep::kAwake;  // for a moment, in exec
    file.wchan.reset();
    return Sleep::kGone;
  }
  if (text[0] == '0') return IsZombie(pid, tid) ? Sleep::kGone : Sleep::kAwake;
  if (IsWork(text.data())) return Sleep::kAwake;
  if (slot.state == State::kBlocked) return Sleep::kAsleep;
  // Cyclone's threads in the robot's process do not say that they wait for a lock. A thread on real
  // time, such as the recorder, has it and soon lets it go.
  if (pid == page_.robot) return Sleep::kAwake;
  return InWaitingCall(pid, tid) ? Sleep::kAsleep : Sleep::kAwake;
}

std::int64_t Sleepers::CpuOf(std::uint32_t index) const {
  const Slot& slot = page_.slots[index];
  return std::strtoll(Read(TaskFile(slot.pid, slot.tid, "schedstat")).c_str(), nullptr, 10);
}

std::string Sleepers::CallOf(std::uint32_t index) const {
  const Slot& slot = page_.slots[index];
  const long number = CallNumber(slot.pid, slot.tid);
  if (number < 0) return "";
  const auto* const call = std::ranges::find(kWaitingCalls, number, &Call::number);
  return call == std::end(kWaitingCalls) ? "system call " + std::to_string(number) : call->name;
}

std::string Sleepers::Describe(std::uint32_t index) const {
  const Slot& slot = page_.slots[index];
  const std::string process = NameOfProcess(slot.pid);
  std::string thread = Read(TaskFile(slot.pid, slot.tid, "comm"));
  if (!thread.empty()) thread.pop_back();  // the end of the line
  return "thread " + std::to_string(slot.tid) + (thread == process ? "" : ", " + thread + ",") +
         " of " + process + " (" + std::to_string(slot.pid) + ")";
}

bool HasEnded(int pid) {
  std::error_code gone;
  const std::filesystem::directory_iterator tasks("/proc/" + std::to_string(pid) + "/task", gone);
  return gone || (std::distance(tasks, {}) <= 1 && IsZombie(pid, pid));
}

bool HasLibrary(int pid) {
  std::ifstream maps("/proc/" + std::to_string(pid) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("/libsimclock.so") != std::string::npos) return true;
  }
  return !maps.eof();  // it cannot be read: of another user, or gone
}

std::string NameOfProcess(int pid) {
  std::string name = Read("/proc/" + std::to_string(pid) + "/comm");
  if (!name.empty()) name.pop_back();  // the end of the line
  return name;
}

}  // namespace understudy::simclock
