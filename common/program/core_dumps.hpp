#pragma once
// Protects the memory of a program, which contains the secret of its session.

#include <sys/prctl.h>

namespace longreach {

/// Excludes it from core dumps, and from access by other programs of the same user (ptrace(2), /proc/PID/mem)
/// except root.
inline void forbid_core_dumps() { (void)::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }

}  // namespace longreach
