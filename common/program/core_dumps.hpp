#pragma once
// Protects the memory of a program, because it contains the secret of the session.

#include <sys/prctl.h>

namespace longreach {

/// Disables core dumps and access by other programs (ptrace(2), /proc/PID/mem), except those of root.
inline void forbid_core_dumps() { (void)::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }

}  // namespace longreach
