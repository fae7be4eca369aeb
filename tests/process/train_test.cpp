// Training that is interrupted, or could not write what it makes.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/process/running_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::train_test {
namespace {

namespace fs = std::filesystem;

/// Interrupts `longreach-lab train` as soon as it trains.
void interrupt(const fs::path& out) {
  RunningProgram program("longreach-lab", {"train", "spherical", "--out", out.string()});
  while (program.running() && program.output().find("training") == std::string::npos)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), 128 + SIGINT) << program.output();
}

TEST(Train, InterruptedItLeavesNoFileAndOneThatWasThereAsItWas) {
  const TemporaryFolder folder;
  interrupt(folder.path() / "new.txtpb");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const fs::path old = folder.write("old.txtpb", "of yesterday\n");
  interrupt(old);
  std::stringstream text;
  text << std::ifstream(old).rdbuf();
  EXPECT_EQ(text.str(), "of yesterday\n");
}

TEST(Train, AFileThatCannotBeWrittenIsRefusedAtOnce) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "none" / "new.txtpb";
  RunningProgram program("longreach-lab", {"train", "spherical", "--out", out});
  EXPECT_EQ(program.wait(std::chrono::seconds(30)), 1);
  EXPECT_EQ(program.output(), "longreach-lab: cannot write " + out + "\n");
}

}  // namespace
}  // namespace longreach::train_test
