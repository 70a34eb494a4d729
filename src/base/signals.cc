#include "base/signals.h"

#include <atomic>
#include <csignal>

namespace understudy {
namespace {

// A global, since signal handlers have no other access to state.
std::atomic<int> stop_signal{0};

void OnStopSignal(int signal) {
  stop_signal = signal;
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
}

}  // namespace

void CatchStopSignals() {
  struct sigaction action {};
  action.sa_handler = OnStopSignal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // SIGHUP stays ignored under `nohup`.
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
  sigaction(SIGXFSZ, &action, nullptr);
}

int StopSignal() { return stop_signal; }

}  // namespace understudy
