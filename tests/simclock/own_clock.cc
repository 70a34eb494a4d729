#include "own_clock.h"

#include <array>

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/unique_fd.h"
#include "exec/child_process.h"
#include "simclock/coordinator.h"
#include "simclock/own_page.h"

namespace understudy::test {

namespace {

// Gives this thread its cores and priority back, which a clock takes: the next one needs them.
class KeptThread {
 public:
  KeptThread() { ::sched_getaffinity(0, sizeof(cores_), &cores_); }
  ~KeptThread() {
    const sched_param usual{};
    ::sched_setscheduler(0, SCHED_OTHER, &usual);
    ::sched_setaffinity(0, sizeof(cores_), &cores_);
  }
  KeptThread(const KeptThread&) = delete;
  KeptThread& operator=(const KeptThread&) = delete;

 private:
  cpu_set_t cores_{};
};

}  // namespace

ClockedRun RunOnClock(const std::vector<std::string>& command, const ClockedOptions& options) {
  using std::chrono::steady_clock;
  const KeptThread kept;
  const UniqueFd file = simclock::MakePage(options.think);
  simclock::Page* const page = simclock::MapPage(file.get());
  page->robot = 0;  // this process has no part in it
  ClockedRun run;
  {
    simclock::Coordinator clock(page, options.realtime, options.most_computing);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return run;
    const UniqueFd out(ends[0]);
    UniqueFd in(ends[1]);
    exec::ChildProcess child(command,
                             {{simclock::kPageVariable, std::to_string(file.get())},
                              {"LD_PRELOAD", UNDERSTUDY_SIMCLOCK}},
                             -1, in.get());
    in.reset();
    clock.Begin();
    child.Release();
    clock.ProgramStarts();
    const auto begun = steady_clock::now();
    int step = 0;
    while (true) {
      if (const auto code = child.Poll()) {
        run.code = *code;
        break;
      }
      run.wall = std::chrono::duration<double>(steady_clock::now() - begun).count();
      if (run.wall > 30) break;
      if (!clock.Reach(std::chrono::milliseconds(step), std::chrono::milliseconds(2))) continue;
      ++step;
      if (options.at_step) options.at_step(step);
    }
    run.simulated = step * 1e-3;
    run.unrepeatable = clock.unrepeatable();
    run.computed = simclock::MedianComputed(*page);
    clock.End();
    std::array<char, 65536> text{};
    const ssize_t size = ::read(out.get(), text.data(), text.size());
    run.printed.assign(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  }
  ::munmap(page, sizeof(*page));
  return run;
}

}  // namespace understudy::test
