#pragma once
// The checks of `longreach doctor`, one section each. They change nothing: the site folder is only read, and
// the sides are queried in the same way as by `longreach status`. Each side also receives five invalid
// datagrams of 508 bytes on its UDP port, which it rejects and counts; the count shows that datagrams of this
// size arrive.

#include "deploy/cli/finding.hpp"
#include "deploy/cli/invocation.hpp"

namespace longreach {

/// Checks the clock, the permissions and the processor, and runs an empty 1 kHz loop for `seconds`.
Section examine_machine(double seconds);
/// Checks the permissions of the site folder and the certificates of each role.
Section examine_site(const Options& options);
/// Checks the availability, version, loop and link of a side. The measurement takes `seconds`.
Section examine_side(Side side, const Options& options, double seconds);

}  // namespace longreach
