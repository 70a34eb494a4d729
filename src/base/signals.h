// Turns SIGINT, SIGTERM and SIGHUP into a flag.
#pragma once

namespace understudy {

// Makes the first SIGINT, SIGTERM or SIGHUP set the flag; a second one ends the process as usual,
// without its temporary folders (base/temporary_folder.h).
// SIGHUP stays ignored under `nohup`. Ignores SIGPIPE and SIGXFSZ: write() reports those errors.
void CatchStopSignals();

// Makes these signals remove the temporary folders before they end the process, where they would
// otherwise just end it. TemporaryFolder calls it.
void EndBySignalsCleanly();

// Returns the signal that set the flag, 0 before.
int StopSignal();

}  // namespace understudy
