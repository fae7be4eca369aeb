#include "common/program/core_dumps.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace longreach::core_dumps_test {
namespace {

TEST(CoreDumps, AreNotMadeOfAProgramThatForbidsThem) {
  const pid_t child = ::fork();
  if (child == 0) {
    forbid_core_dumps();
    ::_exit(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0), 1);  // the test itself, as a control
}

}  // namespace
}  // namespace longreach::core_dumps_test
