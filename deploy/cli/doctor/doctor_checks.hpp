#pragma once
// What the doctor looks at, a section each. Nothing that runs is changed, and nothing is made: the site
// folder is only read, the sides are asked as by `longreach status`. Their UDP ports get five datagrams of
// 508 bytes each that they reject and count, which is how the doctor knows that such datagrams arrive.

#include "deploy/cli/finding.hpp"
#include "deploy/cli/invocation.hpp"

namespace longreach {

/// Clock, rights, processor, and a bare loop of `seconds` at 1 kHz.
Section examine_machine(double seconds);
/// The site folder: who may open it, which roles it has, whether its certificates are good.
Section examine_site(const Options& options);
/// Whether it answers, its version, loop and link; `seconds`: how long it is watched.
Section examine_side(Side side, const Options& options, double seconds);

}  // namespace longreach
