#pragma once
// The log of a program: one event a line, key=value, time in UTC. Written by threads outside the loop only,
// and by none of them: who logs never waits for who reads. Lines that nobody takes are dropped, the oldest
// first, and counted; where lines are missing a line says how many.
//   2026-01-31T12:00:00.123Z info master state from=Observing to=Engaged cause=""
//   2026-01-31T12:00:09.456Z warning master log lost=12

#include <cstdint>
#include <string>

namespace longreach {

/// To a file (appended), or to standard error when `file` is empty. Throws ConfigError that says what to do.
void set_up_log(const std::string& side, const std::string& file);

/// From now on nothing goes to standard error; a file goes on. For who shows the same in another way there.
void hush_log();

/// Waits a moment for what has been logged to be written. At the end of a program.
void close_log();

/// Lines that were dropped or could not be written, since the program's start.
std::uint64_t log_lost();

}  // namespace longreach
