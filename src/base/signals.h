// SIGINT, SIGTERM and SIGHUP as a flag.
#pragma once

namespace understudy {

// From now on SIGINT, SIGTERM and SIGHUP, unless `nohup` has that ignored, only raise the flag,
// once; a second one ends the process the ordinary way. SIGPIPE and SIGXFSZ are ignored: who writes
// learns of it by itself.
void CatchStopSignals();

// The signal that asked us to stop, 0 for none yet.
int StopSignal();

}  // namespace understudy
