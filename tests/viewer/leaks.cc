// Mesa drops a few bytes in libraries that it unloads, which LeakSanitizer can then not name, and
// MuJoCo 2.2.2 64 of each model that it refuses: this program's leaks are not looked for.
extern "C" const char* __asan_default_options();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
