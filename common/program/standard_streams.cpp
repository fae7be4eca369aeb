// Opens /dev/null in place of missing standard streams (a program can be started with `<&-`), so that no socket or file gets
// one of their descriptors and is then read as keystrokes or overwritten with text. Every program that links this file runs
// it at its start, before the initializers of shared libraries, of which gRPC's opens a descriptor.

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace longreach {
namespace {

void fill_standard_streams() {
  // No call that a sanitizer would intercept before it is set up.
  const auto open_null = [] { return ::syscall(SYS_openat, AT_FDCWD, "/dev/null", O_RDWR); };
  long fd = open_null();
  while (fd >= 0 && fd <= STDERR_FILENO) fd = open_null();
  if (fd >= 0) (void)::syscall(SYS_close, fd);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const fill_first)() = fill_standard_streams;

}  // namespace
}  // namespace longreach
