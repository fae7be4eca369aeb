#pragma once
// The log of a program: one event per line, key=value, time in UTC. Only threads outside the loop write to
// it, and they never wait for a reader. If a reader stalls, the oldest lines are dropped and counted; a line
// reports their number.
//   2026-01-31T12:00:00.123Z info master state from=Observing to=Engaged cause=""
//   2026-01-31T12:00:09.456Z warning master log lost=12

#include <cstdint>
#include <string>

namespace longreach {

/// Logs to a file (appended), or to standard error if `file` is empty. Throws ConfigError with a remedy.
void set_up_log(const std::string& side, const std::string& file);

/// Stops the log to standard error; a file continues. For programs that display the events in another way.
void hush_log();

/// Waits briefly until the log is written. Call it at the end of a program.
void close_log();

/// Lines that were dropped or could not be written, since the program's start.
std::uint64_t log_lost();

}  // namespace longreach
