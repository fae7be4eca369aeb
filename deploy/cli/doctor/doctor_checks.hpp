#pragma once
// Checks of the doctor, one section each. It changes and creates nothing: the site folder is only read, and
// the sides are queried as by `longreach status`. Their UDP ports get five datagrams of 508 bytes each that
// they reject and count, which shows that such datagrams arrive.

#include "deploy/cli/finding.hpp"
#include "deploy/cli/invocation.hpp"

namespace longreach {

/// Clock, permissions, processor, and a bare loop of `seconds` at 1 kHz.
Section examine_machine(double seconds);
/// The site folder: its access rights, its roles, and the validity of its certificates.
Section examine_site(const Options& options);
/// Availability, version, loop and link of a side; `seconds`: duration of the measurement.
Section examine_side(Side side, const Options& options, double seconds);

}  // namespace longreach
