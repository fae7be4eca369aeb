#pragma once
// The campaign of faults: program `faults`. How it hangs together:
//
//   schedule   what goes wrong and when, drawn from a seed; a list that can be printed, read, shortened
//   scenario   where: robot, scene, device, link, limits, habits of the operator
//   kind       the table of all kinds of fault; *_kinds.cpp, one a group, each a few lines
//   world      a laboratory with the faults of a schedule in it; it stands between the nodes and everything
//              around them (deploy/lab/fault_hooks.hpp), with wire (who sits on the network) and person
//   ghost      what the master really sent and the slave was given: who had the right to move the robot
//   moment     one tick as an outsider saw it; all that the oracle reads
//   invariant  the oracle; *_invariants.cpp and liveness.cpp, a class an invariant
//   trial      one schedule under the oracle; shrink: the few faults of it that matter
//   tally      many trials; faults.cpp runs them on all cores, in blocks that are kept in the folder --out, so
//              that a campaign that was broken off goes on; faults_table draws what came of it
//
// What needs real programs is in tests/process and not here: kill -9 and restarts, descriptors, disks, pipes,
// RPC, certificates, idle connections, source addresses, wall clocks, local users.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "deploy/lab/experiment.hpp"
#include "tests/faults/tally.hpp"

namespace longreach {

/// Seeds `first` to `first + count - 1`, on all cores.
Tally run_faults(std::uint64_t first, std::uint64_t count, const std::function<void(double)>& progress = {});

/// The whole campaign, from `run.seed` on: half a virtual hour, or 400 with LONGREACH_FULL.
std::vector<Metric> run_fault_campaign(const ExperimentRun& run);
std::vector<Plot> faults_plots();

/// The first of the failures, on standard error: each with the command that repeats it.
void say_failures(const Tally& tally);

/// One seed, or a schedule that was written down: says what is violated, and by which faults at least. False
/// if something is.
bool repeat_faults(const Schedule& schedule, std::string& said);

}  // namespace longreach
