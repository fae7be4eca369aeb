// Manual pages and completion, as man and the shells themselves see them.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/process/running_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::manual_test {
namespace {

const std::vector<std::string> kPrograms{"longreach", "longreach-master", "longreach-slave", "longreach-lab",
                                         "longreach-mujoco"};

std::string said(const std::string& program, const std::vector<std::string>& arguments) {
  RunningProgram run(program, arguments);
  EXPECT_EQ(run.wait(std::chrono::seconds(60)), 0) << program << ": " << run.output();
  return run.output();
}

/// What a shell says to a script.
std::string shell(const std::string& name, const std::string& script) {
  return said("/usr/bin/env", {name, "-c", script});
}

class Manual : public ::testing::Test {
 protected:
  /// The completion of a program in a file of its own.
  std::string file(const std::string& program, const std::string& kind) {
    const std::string path = folder_.path() / (program + "." + kind);
    std::ofstream(path) << said(program, {"--completion", kind});
    return path;
  }
  /// What bash offers for the last of the words.
  std::string bash(const std::string& program, const std::string& words) {
    std::string function = "_" + program;
    for (char& c : function) c = c == '-' ? '_' : c;
    return shell("bash", "source '" + file(program, "bash") + "'; COMP_WORDS=(" + program + " " + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " + function +
                             " 2>/dev/null; echo ${COMPREPLY[@]}");
  }
  std::string zsh(const std::string& program, const std::string& words) {
    return shell("zsh", "compadd() { shift; print -r -- \"$@\" }; _files() { print files $* }; words=(" +
                            program + " " + words + "); CURRENT=$#words; source '" + file(program, "zsh") +
                            "'");
  }
  std::string fish(const std::string& program, const std::string& words) {
    return shell("fish",
                 "source '" + file(program, "fish") + "'; complete -C'" + program + " " + words + "'");
  }

  TemporaryFolder folder_;
};

/// On paper: bold is struck twice.
std::string as_read(const std::string& page) {
  std::string text;
  for (const char c : said("/usr/bin/mandoc", {"-T", "ascii", "-O", "width=500", page})) {
    if (c == '\b' && !text.empty()) {
      text.pop_back();
    } else {
      text += c;
    }
  }
  return text;
}

void expect_has(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
}

TEST_F(Manual, TheManualPageIsSoundAndSaysWhatTheHelpSays) {
  for (const std::string& program : kPrograms) {
    const std::string page = folder_.path() / (program + ".1");
    std::ofstream(page) << said(program, {"--man"});
    EXPECT_EQ(said("/usr/bin/mandoc", {"-T", "lint", "-W", "error", page}), "") << program;
    const std::string read = as_read(page);
    expect_has(read, {"--version", "--man", "--completion", program});
    EXPECT_EQ(read.find("\\f"), std::string::npos);
  }
  const std::string page = folder_.path() / "longreach.1";
  const std::string read = as_read(page);
  expect_has(read, {"shows and changes the state of a running", "adapter check",
                    "check that the adapter follows the protocol rules", "one-way delay (0 to 100 s)",
                    "Exit status: 0 on success", "Example: longreach link blackout 2s"});
}

TEST_F(Manual, BashCompletes) {
  for (const std::string& program : kPrograms)
    EXPECT_EQ(said("/usr/bin/bash", {"-n", file(program, "bash")}), "");
  EXPECT_EQ(bash("longreach", "sta"), "status\n");
  EXPECT_EQ(bash("longreach", "link se"), "set\n");
  EXPECT_EQ(bash("longreach", "link ''"), "show set blackout clear\n");
  EXPECT_EQ(bash("longreach", "--json --timeout 3 mo"), "mode\n");
  EXPECT_EQ(bash("longreach", "mode ''"), "rate position\n");
  EXPECT_EQ(bash("longreach", "get s"), "slave\n");
  EXPECT_EQ(bash("longreach", "get slave ''"), "\n");
  EXPECT_EQ(bash("longreach", "link clear --direction d"), "down\n");
  EXPECT_EQ(bash("longreach", "adapter check --de"), "--device --device-file\n");
  EXPECT_EQ(bash("longreach", "watch --js"), "--json\n");  // an option of all commands
  EXPECT_EQ(bash("longreach-master", "--view p"), "plain\n");
  EXPECT_EQ(bash("longreach-master", "--operator g"), "gamepad\n");
  EXPECT_EQ(bash("longreach-lab", "solve delta-f"), "delta-fk\n");
  std::ofstream(folder_.path() / "mine.txtpb") << "";
  EXPECT_EQ(bash("longreach-slave", "--config " + (folder_.path() / "min").string()),
            (folder_.path() / "mine.txtpb").string() + "\n");
}

TEST_F(Manual, ZshCompletes) {
  for (const std::string& program : kPrograms)
    EXPECT_EQ(said("/usr/bin/env", {"zsh", "-n", file(program, "zsh")}), "");
  EXPECT_EQ(zsh("longreach", "link ''"), "show set blackout clear\n");
  EXPECT_EQ(zsh("longreach", "--json get ''"), "master slave\n");
  EXPECT_EQ(zsh("longreach", "link clear --direction ''"), "up down both\n");
  EXPECT_EQ(zsh("longreach-slave", "--config ''"), "files\n");
}

TEST_F(Manual, FishCompletes) {
  for (const std::string& program : kPrograms)
    EXPECT_EQ(said("/usr/bin/env", {"fish", "-n", file(program, "fish")}), "");
  expect_has(fish("longreach", "link "), {"show", "set", "blackout", "drop all datagrams for a given time"});
  EXPECT_EQ(fish("longreach", "link ").find("status"), std::string::npos);
  expect_has(fish("longreach", "link clear --direction "), {"up", "down", "both"});
  expect_has(fish("longreach-master", "--vi"), {"--view"});
}

}  // namespace
}  // namespace longreach::manual_test
