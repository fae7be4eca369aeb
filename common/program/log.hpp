#pragma once
// The log of a program: one event per line, with key=value pairs and the time in UTC. Only threads other than
// the loop write to it, and they never wait for a reader. If the reader stalls, the oldest lines are dropped,
// and a line reports their number.
//   2026-01-31T12:00:00.123Z info master state from=Observing to=Engaged cause=""
//   2026-01-31T12:00:09.456Z warning master log lost=12

#include <cstdint>
#include <string>

namespace longreach {

/// Appends the log to `file`, or writes it to standard error if `file` is empty. Throws ConfigError with a
/// remedy.
void set_up_log(const std::string& side, const std::string& file);

/// Stops logging to standard error; logging to a file continues. Intended for programs that display the
/// events in another way.
void hush_log();

/// Waits briefly for the log to be written. Call this at the end of the program.
void close_log();

/// Returns the number of lines that were dropped or could not be written since the program started.
std::uint64_t log_lost();

}  // namespace longreach
