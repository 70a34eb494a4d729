#include "base/signals.h"

#include <atomic>
#include <csignal>
#include <initializer_list>

#include "base/temporary_folder.h"

namespace understudy {
namespace {

// A global, since signal handlers have no other access to state.
std::atomic<int> stop_signal{0};

void Handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

void OnLastSignal(int signal) {
  RemoveTemporaryFolders();
  Handle(signal, SIG_DFL);
  ::raise(signal);  // ends the process when this handler returns
}

void OnStopSignal(int signal) {
  stop_signal = signal;
  Handle(signal, &OnLastSignal);
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

void EndBySignalsCleanly() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) {
      Handle(signal, &OnLastSignal);
    }
  }
}

int StopSignal() { return stop_signal; }

}  // namespace understudy
