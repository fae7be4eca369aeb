#pragma once
// Signal handling of a program. SIGINT, SIGTERM and SIGHUP (unless ignored) request the end of the program;
// the third SIGINT or SIGTERM ends it immediately. SIGPIPE is ignored.

#include <atomic>

namespace longreach {

/// Returns a flag that becomes true when the program is requested to end. The first call installs the signal
/// handlers.
std::atomic<bool>& stop_requested();

}  // namespace longreach
