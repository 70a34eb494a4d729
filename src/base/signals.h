// Turns SIGINT, SIGTERM and SIGHUP into a flag.
#pragma once

namespace understudy {

// Makes the first SIGINT, SIGTERM or SIGHUP set the flag; a second one ends the process as usual.
// SIGHUP stays ignored under `nohup`. Ignores SIGPIPE and SIGXFSZ: write() reports those errors.
void CatchStopSignals();

// Returns the signal that set the flag, 0 before.
int StopSignal();

}  // namespace understudy
