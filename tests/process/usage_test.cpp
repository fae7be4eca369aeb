// What a user can do wrong at the start: one sentence on standard error, and an exit status that tells usage
// (2) from failure (1).
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/process/running_program.hpp"
#include "tests/support/station.hpp"
#include "tests/support/temporary_folder.hpp"

namespace longreach::usage_test {
namespace {

struct Ended {
  std::optional<int> status{};
  std::string output;
};

Ended run(const std::string& name, const std::vector<std::string>& arguments) {
  RunningProgram program(name, arguments);
  const auto status = program.wait(std::chrono::seconds(30));
  return {status, program.output()};
}

void expect_one_sentence(const Ended& ended, int status, const std::string& about, const std::string& what) {
  EXPECT_EQ(ended.status, status) << what << ": " << ended.output;
  EXPECT_EQ(std::count(ended.output.begin(), ended.output.end(), '\n'), 1) << what << ": " << ended.output;
  EXPECT_NE(ended.output.find(about), std::string::npos) << what << ": " << ended.output;
}

TEST(Usage, BadOptionsExitWithStatus2AndNameTheOption) {
  for (const std::string name : {"longreach-slave", "longreach-master"}) {
    const auto expect = [&name](const std::vector<std::string>& arguments, const std::string& about) {
      expect_one_sentence(run(name, arguments), 2, about, name + " " + arguments.back());
    };
    expect({"--no-such-option"}, "no-such-option");
    for (const std::string text : {"-3", "0", "nan", "inf", "1x"})
      expect({"--seconds", text}, "--seconds: " + text + " is not a number above 0");
    for (const std::string option : {"--seconds", "--config", "--log", "--record", "--site"})
      expect({option, ""}, option + ": is empty");
    expect({"--record-max-mb", "nan"}, "nan is not a number from 1 to 1000000");
    expect({"--site", "/etc/passwd"}, "/etc/passwd is not a folder");
    expect({"--adapter", "nowhere"}, "adapter.address = nowhere is not an adapter address: write unix:/PATH");
    expect({"--set", "rpc.listen=nowhere"}, "rpc.listen = \"nowhere\" is not an address");
    expect({"--config", "no-such-file.txtpb"}, "no-such-file.txtpb");
    expect({"--set", "loop.rate_hz=1"}, "loop.rate_hz");
    expect({"--set", "loop.rate_hz=nan"}, "loop.rate_hz");
    expect({"--set", "no.such.field=1"}, "no");
    expect({"--set", "loop.rate_hz"}, "loop.rate_hz");
    expect({"--set", "link.listen=nowhere"}, "nowhere");
    expect({"--profile", "no-such-link"}, "no-such-link");
  }
  for (const std::string law : {"NAIVE", "DIRECT", "POSITION_POSITION", "WAVE", "TDPA", "TANK"})
    expect_one_sentence(run("longreach-master", {"--set", "rendering.law=" + law}), 2,
                        "rendering.law = " + law +
                            " is for comparison and available only in longreach-lab; leave it out or set "
                            "STIFFNESS",
                        law);
  expect_one_sentence(run("longreach-master", {"--operator", "ghost"}), 2, "ghost", "--operator ghost");
  expect_one_sentence(run("longreach-master", {"--wall", "nan"}), 2, "--wall: nan", "--wall nan");
  expect_one_sentence(run("longreach-slave", {"--pair", "--pair-listen", "127.0.0.1:99999"}), 2,
                      "--pair-listen: '127.0.0.1:99999' is not an address", "--pair-listen");
  expect_one_sentence(run("longreach-master", {"--mode", "sideways"}), 2, "sideways", "--mode sideways");
}

TEST(Usage, OfTheLaboratoryToo) {
  const auto expect = [](const std::vector<std::string>& arguments, const std::string& about) {
    expect_one_sentence(run("longreach-lab", arguments), 2, about, arguments.back());
  };
  for (const std::string seed : {"-1", "1.5", "18446744073709551616", "one"})
    expect({"run", "touch", "--seed", seed}, "--seed: " + seed + " is not a whole number");
  for (const std::string seeds : {"5:1", "1:", "-1:2", "one", "1:2:3", "1:999999"})
    expect({"run", "touch", "--seeds", seeds}, "--seeds " + seeds);
  expect({"run", "touch", "--seeds", ""}, "--seeds: is empty");
  expect({"run", "touch", "--seed", "1", "--seeds", "1:2"}, "--seed");
  expect({"run", "touch", "--seeds", "1:2", "--out", "a", "--record"}, "--record requires a single seed");
  expect({"run", "touch", "--only", "slot"}, "--only requires an experiment with named trials");
  expect({"run", "person", "--only", "no-such-trial"}, "--only no-such-trial matches no trial");
  expect({"report", "--out", "a", "--seed", "-1"}, "--seed: -1 is not");
  expect({"train", "spherical", "--seed", "-1"}, "--seed: -1 is not");
  expect({"run", "touch", "--out", ""}, "--out: is empty");
  expect({"run", "touch", "--out", "/proc/longreach"}, "cannot create the folder /proc/longreach");
  expect({"run", "touch", "--out", "/etc/passwd"}, "cannot create the folder /etc/passwd");
  expect({"run", "first-touch", "--set", "profile=lab"},
         "first-touch does not use profile; it uses these settings: ");
  expect({"run", "scenes-cost", "--set", "profile=lab"},
         "scenes-cost does not use profile or any other setting");
  expect({"run", "faults"}, "run `build/release/bin/faults`");
  expect({"run", "press-wall", "--set", "rendering.law=STIFFNESS"},
         "press-wall runs only the textbook laws; for rendering.law = STIFFNESS run the experiment touch");
  expect({"report", "--out", "/proc/longreach"}, "choose another folder with --out");
  expect({"solve", "identify", "--exponent", "nan"}, "nan is not a number from 0.5 to 3.5");
  expect({"nope"}, "nope is not a command");
}

TEST(Usage, ARunWithoutContactEndsWithStatus3) {
  for (const bool quiet : {false, true}) {
    std::vector<std::string> arguments{"run",         "touch", "--set",
                                       "profile=lab", "--set", "scene_file=scenes/free.txtpb"};
    if (quiet) arguments.emplace_back("--quiet");
    RunningProgram program("longreach-lab", arguments);
    EXPECT_EQ(program.wait(std::chrono::minutes(2)), 3);
    EXPECT_EQ(program.output().find("outcome: no contact\n") != std::string::npos, !quiet)
        << program.output();
    EXPECT_EQ(program.output().find("displayed_stiffness_error"), std::string::npos) << program.output();
  }
}

TEST(Usage, ReferenceAdaptersTakeAPathAndNothingElse) {
  for (const std::string name : {"longreach-reference-device", "longreach-reference-robot"})
    for (const std::string path : {"99999", "-1", "abc", "--help", ""})
      expect_one_sentence(run(name, {path}), 2, "usage: " + name + " PATH", name + " " + path);
}

TEST(Usage, AConfigurationFileWithAMistakeIsNamedWithItsLine) {
  const auto file =
      std::filesystem::temp_directory_path() / ("longreach-bad-" + std::to_string(getpid()) + ".txtpb");
  std::ofstream(file) << "loop {\n  rate_hz: 1000\n  speed: 3\n}\n";
  expect_one_sentence(run("longreach-slave", {"--config", file.string()}), 2, file.string() + ":3",
                      "unknown field");
  std::filesystem::remove(file);
}

TEST(Usage, ARobotFileWithABadRowIsNamedWithLineFieldAndReason) {
  const auto file =
      std::filesystem::temp_directory_path() / ("longreach-robot-" + std::to_string(getpid()) + ".txtpb");
  const auto expect = [&](const std::string& third_row, const std::string& about) {
    std::ofstream(file) << "joint { a_m: 1 }\njoint { a_m: 1 }\n"
                        << third_row << "\njoint { a_m: 1 }\njoint { a_m: 1 }\njoint { a_m: 1 }\n";
    expect_one_sentence(run("longreach-slave", {"--set", "robot_file=" + file.string()}), 2,
                        file.string() + ":" + about, third_row);
  };
  expect("joint { a_m: nan }", "3:9: joint.2.a_m = nan is not a finite number");
  expect("joint { alpha_rad: 0 }", "3:9: joint.2.alpha_rad = 0 with a_m = 0 makes joints 2 and 3 rotate");
  expect("joint { a_m: 1 min_rad: 2 max_rad: 1 }", "3:16: joint.2.min_rad = 2 is not below max_rad = 1");
  expect("joint { a_m: 1 } joint { a_m: 1 }", "1:1: joint has 7 elements; 6 are needed");
  std::filesystem::remove(file);
}

TEST(Usage, CheckPrintsTheConfigurationAndStartsNothing) {
  const Ended slave = run("longreach-slave", {"--check", "--set", "safety.gap_s=0.25", "--profile", "moon"});
  EXPECT_EQ(slave.status, 0) << slave.output;
  EXPECT_NE(slave.output.find("gap_s: 0.25"), std::string::npos) << slave.output;
  EXPECT_NE(slave.output.find("delay_s: 1.3"), std::string::npos) << slave.output;
  const Ended stiff =
      run("longreach-slave", {"--check", "--set", "scene.material.wall.stiffness_n_per_m=4321"});
  EXPECT_EQ(stiff.status, 0) << stiff.output;
  EXPECT_NE(stiff.output.find("stiffness_n_per_m: 4321"), std::string::npos) << stiff.output;
  const Ended master = run("longreach-master", {"--check", "--engage", "--mode", "rate"});
  EXPECT_EQ(master.status, 0) << master.output;
  EXPECT_NE(master.output.find("engage_at_start: true"), std::string::npos) << master.output;
  EXPECT_NE(master.output.find("mode: RATE"), std::string::npos) << master.output;
  // Of a device file that says nothing of them.
  const Ended falcon = run("longreach-master", {"--check", "--set", "device_file=devices/falcon.txtpb"});
  for (const char* part :
       {"turns: false", "# the handle does not turn: the orientation of the robot is constant", "behaviour {",
        "spherical {", "gravity_m_per_s2: [0, -9.81, 0]"})
    EXPECT_NE(falcon.output.find(part), std::string::npos) << part << falcon.output;
  EXPECT_NE(master.output.find("gravity_m_per_s2: [0, 0, -9.81]"), std::string::npos) << master.output;
}

TEST(Usage, AnEditedCopyOfTheFilesIsReadAndNamed) {
  const TemporaryFolder folder;
  const std::filesystem::path copy = folder.path() / "copy";
  std::filesystem::copy(LONGREACH_DEPLOY, copy, std::filesystem::copy_options::recursive);
  std::ofstream(copy / "scenes/wall.txtpb") << "name: \"edited\"\n";
  std::ofstream(copy / "links/mine.txtpb") << "up { delay_s: 0.123 }\n";
  const std::string config = copy / "config/slave.txtpb", scene = copy / "scenes/wall.txtpb";
  const Ended check =
      run("longreach-slave", {"--config", config, "--check", "--profile", copy / "links/mine.txtpb"});
  EXPECT_EQ(check.status, 0) << check.output;
  for (const std::string& words :
       {"# config=" + config + "\n# profile=" + copy.string() + "/links/mine.txtpb\n",
        "# scene_file=" + scene + "\n# robot_file=" + copy.string() + "/robots/",
        std::string("name: \"edited\""), std::string("delay_s: 0.123")}) {
    EXPECT_NE(check.output.find(words), std::string::npos) << words << check.output;
  }
  const Ended start = run("longreach-slave", {"--config", config, "--insecure", "--seconds", "0.1", "--set",
                                              "link.listen=127.0.0.1:0", "--set", "rpc.listen=127.0.0.1:0"});
  EXPECT_EQ(start.status, 0) << start.output;
  EXPECT_NE(start.output.find(" scene_file=" + scene), std::string::npos) << start.output;
}

TEST(Usage, ASingularStartPoseIsReported) {
  const auto output = [](const std::string& elbow_rad) {
    return run("longreach-slave", {"--insecure", "--seconds", "0.1", "--set", "robot_file=robots/ur10.txtpb",
                                   "--set", "robot.joint.2.start_rad=" + elbow_rad, "--set",
                                   "link.listen=127.0.0.1:0", "--set", "rpc.listen=127.0.0.1:0"})
        .output;
  };
  EXPECT_NE(output("0").find("start pose=singular conditioning=0.0"), std::string::npos) << output("0");
  EXPECT_EQ(output("1.5").find("singular"), std::string::npos) << output("1.5");
}

TEST_F(Station, APortThatIsTakenEndsTheSecondProgramWithStatus1) {
  start_slave();
  ASSERT_TRUE(eventually([this] { return slave_.state() == "Idle"; })) << outputs();
  const Ended second = run("longreach-slave", {"--set", "link.listen=" + link_address()});
  expect_one_sentence(second, 1, "link.listen", "same port");
  const Ended third = run("longreach-slave", {"--set", "link.listen=127.0.0.1:0", "--set",
                                              "rpc.listen=127.0.0.1:" + std::to_string(ports_.slave_rpc)});
  expect_one_sentence(third, 1, "rpc", "same RPC port");
}

TEST(Usage, InsecureIsForThisMachineOnlyAndSaysWhatItIs) {
  const Ended open = run("longreach-slave",
                         {"--insecure", "--set", "link.listen=127.0.0.1:0", "--set", "rpc.listen=0.0.0.0:0"});
  EXPECT_EQ(open.status, 1) << open.output;
  EXPECT_NE(open.output.find("omit --insecure"), std::string::npos) << open.output;
  const Ended local = run("longreach-slave", {"--insecure", "--seconds", "0.2", "--set",
                                              "link.listen=127.0.0.1:0", "--set", "rpc.listen=127.0.0.1:0"});
  EXPECT_EQ(local.status, 0) << local.output;
  EXPECT_NE(local.output.find("INSECURE"), std::string::npos) << local.output;
}

TEST(Usage, ASiteThatOthersMayOpenEndsTheProgramWithStatus1) {
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  for (const std::string name : {"longreach-slave", "longreach-master"})
    expect_one_sentence(run(name, {"--site", folder.path().string()}), 1, "is accessible to other users",
                        name);
}

TEST(Usage, ARunOfGivenLengthEndsByItself) {
  const Ended slave = run("longreach-slave", {"--seconds", "0.5", "--set", "link.listen=127.0.0.1:0", "--set",
                                              "rpc.listen=127.0.0.1:0"});
  EXPECT_EQ(slave.status, 0) << slave.output;
  EXPECT_NE(slave.output.find("end ticks="), std::string::npos) << slave.output;
}

}  // namespace
}  // namespace longreach::usage_test
