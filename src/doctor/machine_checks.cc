// Whether the machine is fast, has the rights and keeps time.
#include <algorithm>
#include <cmath>

#include "doctor/findings.h"

namespace understudy::doctor {
namespace {

constexpr double kLateWaking = 1e-3;  // s: half a period; *assumed*

bool IsLoopback(const Measurements& seen) { return seen.link && seen.link->loopback; }

Finding Buffers(const Measurements& seen) {
  if (!seen.receive_buffer || !seen.send_buffer) return NotSeen("no socket could be made");
  const std::string text = fmt::format(
      "{} KiB to receive (Cyclone asks for {}), {} KiB to send ({})", *seen.receive_buffer >> 10,
      kCycloneReceive >> 10, *seen.send_buffer >> 10, kCycloneSend >> 10);
  const Figures figures = {{"receive", *seen.receive_buffer}, {"send", *seen.send_buffer}};
  std::string remedy;
  if (*seen.receive_buffer < kCycloneReceive) {
    remedy += fmt::format(" net.core.rmem_max={}", kCycloneReceive);
  }
  if (*seen.send_buffer < kCycloneSend)
    remedy += fmt::format(" net.core.wmem_max={}", kCycloneSend);
  if (remedy.empty()) return With(Ok(text), figures);
  return With(Warning(text, "as root: sysctl -w" + remedy), figures);
}

Finding Dropped(const Measurements& seen) {
  if (!seen.dropped) return NotSeen("the kernel did not tell");
  const DropCounts& counts = *seen.dropped;
  const std::string text = fmt::format(
      "{} damaged, {} dropped on {}; {} found a receive buffer full", counts.interface_errors,
      counts.interface_dropped, seen.question.interface, counts.buffer_full);
  const Figures figures = {{"damaged", static_cast<double>(counts.interface_errors)},
                           {"dropped", static_cast<double>(counts.interface_dropped)},
                           {"buffer_full", static_cast<double>(counts.buffer_full)}};
  if (counts.buffer_full > 0) {
    return With(Warning(text, "a program reads too slowly, or its buffers are small: see buffers"),
                figures);
  }
  if (counts.interface_errors > 0) {
    return With(Warning(text, "try another cable or port"), figures);
  }
  if (counts.interface_dropped > 0) {
    return With(Warning(text, "see load; ip -s link tells which way they went"), figures);
  }
  return With(Ok(text), figures);
}

Finding Realtime(const Measurements& seen) {
  if (!seen.rights) return NotSeen("not asked for");
  if (seen.rights->fifo) return Ok("SCHED_FIFO is granted");
  return Warning(fmt::format("no SCHED_FIFO: the rtprio limit is {}", seen.rights->priority_limit),
                 "an rtprio limit of 10, or CAP_SYS_NICE (docs/reference/realtime.md)");
}

Finding Memory(const Measurements& seen) {
  if (!seen.rights) return NotSeen("not asked for");
  if (seen.rights->locked) return Ok("may be locked");
  return Warning(fmt::format("may not be locked: the memlock limit is {} KiB",
                             seen.rights->memory_limit >> 10),
                 "an unlimited memlock limit, or CAP_IPC_LOCK (docs/reference/realtime.md)");
}

Finding Governor(const Measurements& seen) {
  if (seen.governors.empty()) return NotSeen("the kernel shows none, as in a virtual machine");
  if (seen.governors == std::vector<std::string>{"performance"}) return Ok("performance");
  return Warning(Listed(seen.governors) + ": cores slow down between two commands",
                 "as root: cpupower frequency-set -g performance");
}

Finding Load(const Measurements& seen) {
  if (!seen.load) return NotSeen("the kernel did not tell");
  const std::string text = fmt::format("{:.1f} on {} cores", *seen.load, seen.cores);
  const Figures figures = {{"load", *seen.load}, {"cores", seen.cores}};
  if (*seen.load <= seen.cores) return With(Ok(text), figures);
  return With(
      Warning(text + ": programs wait for one another", "end what the test does not need (top)"),
      figures);
}

Finding Wakings(const Measurements& seen) {
  const Spread& late = seen.lateness;
  if (late.count == 0) return NotSeen("nothing was measured");
  const std::string text = fmt::format("an ordinary thread woke {} late p50, {} p99, {} worst",
                                       Ms(late.p50), Ms(late.p99), Ms(late.worst));
  const Figures figures = {{"p50", late.p50}, {"p99", late.p99}, {"worst", late.worst}};
  if (late.p99 <= kLateWaking) return With(Ok(text), figures);
  return With(
      Warning(text, "see load and governor; real-time rights help (docs/reference/realtime.md)"),
      figures);
}

Finding ClockSource(const Measurements& seen) {
  if (seen.clock_source.empty()) return NotSeen("the kernel did not tell");
  constexpr std::string_view kSlow[] = {"hpet", "acpi_pm", "pit", "jiffies", "refined-jiffies"};
  if (std::ranges::find(kSlow, seen.clock_source) == std::end(kSlow)) return Ok(seen.clock_source);
  return Warning(seen.clock_source + ": coarse, or slow to read",
                 "find out in the kernel's log why it is not tsc (dmesg)");
}

Finding ClockSteps(const Measurements& seen) {
  const ClockCourse& clock = seen.clock;
  const Figures figures = {{"steps", clock.steps}, {"largest", clock.largest}};
  if (clock.steps == 0) return With(Ok("the system's clock did not jump"), figures);
  return With(Wrong(fmt::format("the system's clock jumped {} times, by {:+.3f} s at most",
                                clock.steps, clock.largest),
                    "let one daemon alone set it, by slewing (chrony: makestep 1 3)"),
              figures);
}

Finding ClockSynchronised(const Measurements& seen) {
  if (!seen.sync) return NotSeen("the kernel did not tell");
  if (seen.sync->synchronised) {
    return With(Ok("to " + Ms(seen.sync->error)), {{"error", seen.sync->error}});
  }
  if (IsLoopback(seen)) return Ok("no daemon keeps it right, and one machine needs none");
  return Warning("no daemon keeps it right: times that two machines record cannot be compared",
                 "run chrony or ptp4l with phc2sys, on both machines");
}

Finding ClockApart(const Measurements& seen) {
  if (!seen.peer) return NotSeen(kNoPeer);
  if (!seen.peer->offset) return NotSeen("no message came back from the peer");
  const ClockOffset& offset = *seen.peer->offset;
  const std::string text =
      fmt::format("the peer's is {:+.2f} ms ahead, to {}", offset.ahead * 1e3, Ms(offset.error));
  const Figures figures = {{"ahead", offset.ahead}, {"error", offset.error}};
  if (std::abs(offset.ahead) - offset.error <= kLatePeriod) return With(Ok(text), figures);
  return With(Warning(text + ": times that the two record cannot be compared",
                      "run chrony or ptp4l with phc2sys, on both machines"),
              figures);
}

constexpr Check kMachineChecks[] = {
    {"buffers", "what a socket gets that asks for as much as Cyclone DDS does", Buffers},
    {"dropped", "packets lost on the interface and before full buffers, in the test", Dropped},
    {"real-time", "may a robot's loop run under SCHED_FIFO", Realtime},
    {"memory", "may its memory be locked", Memory},
    {"governor", "how the cores' frequency is chosen", Governor},
    {"load", "programs that wanted to run in the last minute, for each core", Load},
    {"wakings", "how late a thread wakes that sleeps for 2 ms", Wakings},
    {"clock source", "what the kernel reads time from", ClockSource},
    {"clock steps", "jumps of the system's clock against the monotonic one, in the test",
     ClockSteps},
    {"clock sync", "does a daemon of NTP or PTP keep the system's clock", ClockSynchronised},
    {"clock offset", "how far the peer's system clock is ahead of ours", ClockApart},
};

}  // namespace

std::span<const Check> MachineChecks() { return kMachineChecks; }

}  // namespace understudy::doctor
