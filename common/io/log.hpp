#pragma once
// The log of a program: one event a line, key=value, time in UTC. Written by threads outside the loop only.
//   2026-01-31T12:00:00.123Z info master state from=Observing to=Engaged cause=""

#include <string>

namespace longreach {

/// To a file (appended, flushed a line at a time), or to standard error when `file` is empty. `quiet`:
/// nowhere unless there is a file. Throws ConfigError that says what to do.
void set_up_log(const std::string& side, const std::string& file, bool quiet = false);

}  // namespace longreach
