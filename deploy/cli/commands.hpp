#pragma once
// Runs the command and prints the result. Throws SideError, UsageError or ConfigError on failure.

#include <functional>
#include <string>

#include "deploy/cli/invocation.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {

ExitStatus run(const Invocation& invocation);

// Each of these commands has its own source file.
ExitStatus run_watch(const Options& options, const WatchCommand& command);
ExitStatus run_view(const Options& options, const ViewCommand& command);
ExitStatus run_doctor(const Options& options, const DoctorCommand& command);
ExitStatus run_record(const Options& options, const RecordCommand& command);
ExitStatus run_adapter_check(const Options& options, const AdapterCheckCommand& command);
ExitStatus run_robot(const Options& options, const RobotCommand& command);
ExitStatus run_demo(const DemoCommand& command);
ExitStatus run_task(const Options& options, const TaskCommand& command);
ExitStatus run_pair(const Options& options, const PairCommand& command);
ExitStatus run_unpair(const Options& options, const UnpairCommand& command);
ExitStatus run_stop(const Options& options);
ExitStatus run_link_show(const Options& options);
ExitStatus run_link_set(const Options& options, const LinkSetCommand& command);

/// Changes both directions or neither: if the second side rejects its change, the first change is undone.
/// Returns a description of the change.
std::string set_link(const Options& options, const LinkSetCommand& command);
/// Stops both sides, and succeeds if at least one of them stops. Both are asked directly and at once. The master also
/// passes the stop to the slave in its session, which over a slow link is faster than RPC, and reports the slave's
/// state. Returns what was stopped and what was not; `say` is called with each part as soon as it is known.
std::string stop_sides(const Options& options, const std::function<void(const std::string&)>& say = {});

/// Prints a description of the change as a sentence or, with JSON, as {"done": ...}.
void print_done(const Options& options, const std::string& sentence);
/// Prints an error as a sentence on stderr and, with JSON, also as {"error": ...} on stdout.
void print_error(bool json, const std::string& sentence);

}  // namespace longreach
