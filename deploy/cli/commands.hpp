#pragma once
// Carries out what was asked for. Prints the answer; throws SideError, UsageError or ConfigError for the
// rest.

#include <string>

#include "deploy/cli/invocation.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {

ExitStatus run(const Invocation& invocation);

// One file each.
ExitStatus run_watch(const Options& options, const WatchCommand& command);
ExitStatus run_view(const Options& options, const ViewCommand& command);
ExitStatus run_doctor(const Options& options, const DoctorCommand& command);
ExitStatus run_record(const Options& options, const RecordCommand& command);
ExitStatus run_adapter_check(const Options& options, const AdapterCheckCommand& command);
ExitStatus run_pair(const Options& options, const PairCommand& command);
ExitStatus run_unpair(const Options& options, const UnpairCommand& command);
ExitStatus run_link_show(const Options& options);
ExitStatus run_link_set(const Options& options, const LinkSetCommand& command);

/// Both directions, or none: a direction that was changed is put back when the other one refuses. Returns
/// what was done.
std::string set_link(const Options& options, const LinkSetCommand& command);
/// Done when one of them has answered; likewise.
std::string stop_sides(const Options& options);

/// Prints what was done: a sentence, or {"done": ...}.
void print_done(const Options& options, const std::string& sentence);
/// Prints an error as it was announced: a sentence on stderr, and with JSON {"error": ...} on stdout.
void print_error(bool json, const std::string& sentence);

}  // namespace longreach
