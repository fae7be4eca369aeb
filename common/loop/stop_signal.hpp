#pragma once
// SIGINT, SIGTERM and SIGHUP, unless it is ignored, ask a program to end; the third SIGINT or SIGTERM ends it
// at once. SIGPIPE is ignored.

#include <atomic>

namespace longreach {

/// Becomes true when the program has been asked to end. The first call installs the answers to the signals.
std::atomic<bool>& stop_requested();

}  // namespace longreach
