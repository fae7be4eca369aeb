#pragma once
// The fault campaign, program `faults`. Its parts:
//
//   schedule   faults and their times, drawn from a seed; a list that can be printed, read and shortened
//   scenario   robot, scene, device, link, limits and behaviour of the operator
//   kind       the table of all kinds of fault; *_kinds.cpp, one file per group, a few lines per kind
//   world      a laboratory with the faults of a schedule, which are applied between the nodes and their
//              environment (deploy/lab/fault_hooks.hpp); with wire (the network and its attacker) and person
//   sent_log   what the master sent and the slave received: whether the robot was permitted to move
//   moment     one tick as observed from outside; the only input of the oracle
//   invariant  the oracle; *_invariants.cpp and liveness.cpp, one class per invariant
//   trial      one schedule under the oracle; shrink: reduces it to the few faults that cause a failure
//   tally      the results of many trials; faults.cpp runs them on all cores, in blocks that are stored in the
//              folder --out, so that an interrupted campaign can resume; faults_table writes the results
//
// Tests that need real programs are in tests/process. They cover kill -9 and restarts, descriptors, disks,
// pipes, RPC, certificates, idle connections, source addresses, wall clocks and local users.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "deploy/lab/experiment.hpp"
#include "tests/faults/tally.hpp"

namespace longreach {

/// Runs the seeds `first` to `first + count - 1` on all cores; `progress` receives the completed fraction.
Tally run_faults(std::uint64_t first, std::uint64_t count, const std::function<void(double)>& progress = {});

/// Runs the whole campaign, starting with the seed `run.seed`. It lasts half an hour of virtual time, or 400
/// hours if LONGREACH_FULL is set.
std::vector<Metric> run_fault_campaign(const ExperimentRun& run);
std::vector<Plot> faults_plots();

/// Prints the first failures to standard error, each with the command that reproduces it.
void say_failures(const Tally& tally);

/// Runs a schedule again. Writes to `said` the violations and a minimal set of faults that causes them.
/// Returns false if there is a violation.
bool repeat_faults(const Schedule& schedule, std::string& said);

}  // namespace longreach
