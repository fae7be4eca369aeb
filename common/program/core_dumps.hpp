#pragma once
// The memory of a program holds the secret of its session.

#include <sys/prctl.h>

namespace longreach {

/// No core dump shows it, and no other program of the same user (ptrace(2), /proc/PID/mem) but root's.
inline void forbid_core_dumps() { (void)::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }

}  // namespace longreach
