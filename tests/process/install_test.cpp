// What `cmake --install` leaves on a host: programs that find their files without the source tree, and units
// that systemd understands.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/process/running_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::install_test {
namespace {

void expect_done(const std::string& program, const std::vector<std::string>& arguments, std::string& said) {
  RunningProgram run(program, arguments);
  EXPECT_EQ(run.wait(std::chrono::seconds(60)), 0) << program << ": " << run.output();
  said = run.output();
}

TEST(Install, ProgramsFindTheirFilesAndUnitsAreValid) {
  const TemporaryFolder folder;
  const std::string prefix = folder.path() / "there";
  const std::string build = std::filesystem::path(LONGREACH_BIN).parent_path();
  std::string said;
  expect_done("/usr/bin/cmake", {"--install", build, "--prefix", prefix}, said);
  for (const std::string side : {"slave", "master"}) {
    const std::string config = prefix + "/etc/longreach/" + side + ".txtpb";
    // From a folder, and in an environment, that do not lead to the source tree.
    expect_done("/usr/bin/env",
                {"--chdir=/", "--unset=LONGREACH_HOME", prefix + "/bin/longreach-" + side, "--config", config,
                 "--profile", "moon", "--check"},
                said);
    EXPECT_NE(said.find("delay_s: 1.3"), std::string::npos) << said;
    expect_done("/usr/bin/systemd-analyze",
                {"verify", prefix + "/lib/systemd/system/longreach-" + side + ".service"}, said);
    EXPECT_EQ(said, "");
    std::ofstream(config) << "# edited\n";
  }
  RunningProgram laboratory(prefix + "/bin/longreach-lab", {"list"});
  EXPECT_EQ(laboratory.wait(std::chrono::seconds(60)), 0) << laboratory.output();
  for (const char* file : {"/share/man/man1/longreach-lab.1", "/share/longreach/cluster/parallel"})
    EXPECT_TRUE(std::filesystem::exists(prefix + file)) << file;
  // A vendor copies this folder and has all that an adapter needs.
  for (const std::string kind : {"device", "robot"}) {
    const std::string adapters = prefix + "/share/longreach/adapters/";
    for (const std::string compiler : {"/usr/bin/g++", "/usr/bin/clang++"}) {
      if (!std::filesystem::exists(compiler)) continue;
      // A driver's kit may ask for an old standard and for every warning.
      for (const std::string standard : {"14", "20"}) {
        expect_done(compiler,
                    {"-std=c++" + standard, "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow",
                     "-I", adapters, adapters + kind + "_adapter.cpp", "-o", prefix + "/" + kind},
                    said);
        EXPECT_EQ(said, "") << compiler << standard;
      }
    }
  }
  // A second installation leaves alone what somebody has edited.
  expect_done("/usr/bin/cmake", {"--install", build, "--prefix", prefix}, said);
  std::ifstream edited(prefix + "/etc/longreach/slave.txtpb");
  std::string line;
  std::getline(edited, line);
  EXPECT_EQ(line, "# edited");
}

}  // namespace
}  // namespace longreach::install_test
