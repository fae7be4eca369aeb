#include "deploy/cli/command_line.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/config/config.hpp"

namespace longreach::command_line_test {
namespace {

std::variant<Invocation, Printout> parse(std::vector<const char*> words) {
  words.insert(words.begin(), "longreach");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

template <class Asked>
Asked command(const std::vector<const char*>& words) {
  return std::get<Asked>(std::get<Invocation>(parse(words)).command);
}

/// The sentence with which a command line is refused; empty when it is not.
std::string refusal(const std::vector<const char*>& words) {
  try {
    parse(words);
    return "";
  } catch (const UsageError& error) {
    return error.what();
  } catch (const ConfigError& error) {
    return error.what();
  }
}

void expect_refused(const std::vector<const char*>& words, const std::string& about) {
  EXPECT_NE(refusal(words).find(about), std::string::npos) << words.back() << ": '" << refusal(words) << "'";
}

TEST(CommandLine, TimesAndFractionsOfALinkAreReadWithTheirUnits) {
  struct Case {
    const char* text;
    double value;
  };
  for (const Case& c : {Case{"650ms", 0.65}, Case{"1.3s", 1.3}, Case{"20us", 20e-6}, Case{"1.3", 1.3},
                        Case{"0", 0.0}, Case{"100", 100.0}, Case{"1e-9", 1e-9}})
    EXPECT_EQ(command<LinkSetCommand>({"link", "set", "--delay", c.text}).fields.delay_s(), c.value)
        << c.text;
  for (const Case& c : {Case{"2%", 0.02}, Case{"0.02", 0.02}, Case{"100%", 1.0}, Case{"0%", 0.0}})
    EXPECT_EQ(command<LinkSetCommand>({"link", "set", "--loss", c.text}).fields.loss(), c.value) << c.text;
}

TEST(CommandLine, DemoPassesOnTheGivenOptionsAlone) {
  const auto demo = command<DemoCommand>({"demo", "--seconds", "30", "--set", "command.force_guard_n=9",
                                          "--logs", "there", "--set", "mapping.scale=0.5"});
  EXPECT_EQ(demo.arguments, (std::vector<std::string>{"--seconds", "30", "--set", "command.force_guard_n=9",
                                                      "--set", "mapping.scale=0.5"}));
  EXPECT_EQ(demo.logs, "there");
  EXPECT_TRUE(command<DemoCommand>({"demo"}).arguments.empty());
  expect_refused({"demo", "--operator", "somewhere"}, "--operator");
}

TEST(CommandLine, EveryOptionOfALinkSetsItsOwnField) {
  const auto set = command<LinkSetCommand>({"link",      "set",  "--delay",      "1s",  "--jitter",    "2ms",
                                            "--loss",    "3%",   "--loss-burst", "4",   "--duplicate", "5%",
                                            "--reorder", "6%",   "--corrupt",    "7%",  "--rate",      "8e3",
                                            "--rpc",     "2.6s", "--direction",  "down"});
  proto::Impairment expected;
  expected.set_delay_s(1.0);
  expected.set_jitter_s(0.002);
  expected.set_loss(0.03);
  expected.set_loss_burst(4.0);
  expected.set_duplicate(0.05);
  expected.set_reorder(0.06);
  expected.set_corrupt(0.07);
  expected.set_rate_bit_per_s(8000.0);
  expected.set_rpc_delay_s(2.6);
  EXPECT_EQ(set.fields.SerializeAsString(), expected.SerializeAsString()) << set.fields.DebugString();
  EXPECT_EQ(set.direction, Direction::kDown);
  EXPECT_FALSE(set.profile.has_value());
  EXPECT_FALSE(set.clear);
}

TEST(CommandLine, RefusesLinkValuesOutOfRange) {
  expect_refused({"link", "set", "--loss", "2"}, "loss");
  expect_refused({"link", "set", "--loss", "2"}, "0 to 1");
  expect_refused({"link", "set", "--delay", "100.1s"}, "0 to 100");
  expect_refused({"link", "set", "--delay", "-1ms"}, "delay_s");
  for (const char* text : {"nan", "inf", "1e400", "fast", "1 h", "1.3 s", "2%"})
    expect_refused({"link", "set", "--delay", text}, "delay_s");
  expect_refused({"link", "set", "--delay", ""}, "--delay: is empty");
  expect_refused({"link", "blackout", "-2s"}, "blackout_duration_s");
  expect_refused({"link", "set"}, "needs --profile or at least one field");
  expect_refused({"link", "set", "--direction", "up"}, "needs --profile or at least one field");
  expect_refused({"link", "set", "--loss", "1%", "--direction", "left"}, "left");
}

TEST(CommandLine, ABlackoutBeginsNowAndComesOnce) {
  const auto set = command<LinkSetCommand>({"link", "blackout", "500ms", "--direction", "up"});
  EXPECT_EQ(set.fields.blackout_duration_s(), 0.5);
  EXPECT_TRUE(set.fields.has_blackout_start_s());
  EXPECT_EQ(set.fields.blackout_start_s(), 0.0);
  EXPECT_TRUE(set.fields.has_blackout_period_s());
  EXPECT_EQ(set.fields.blackout_period_s(), 0.0);
  EXPECT_EQ(set.direction, Direction::kUp);
}

TEST(CommandLine, NamesOfCommandsMayBePathsOfFields) {
  EXPECT_EQ(command<GetCommand>({"get", "slave", "link"}).path, "link");
  const auto set = command<SetCommand>({"set", "master", "scale", "stop", "link", "-1e-3"});
  EXPECT_EQ(set.side, Side::kMaster);
  ASSERT_EQ(set.assignments.size(), 2U);
  EXPECT_EQ(set.assignments[0], (std::pair<std::string, std::string>("scale", "stop")));
  EXPECT_EQ(set.assignments[1], (std::pair<std::string, std::string>("link", "-1e-3")));
}

TEST(CommandLine, TakesNoTokenInItsArguments) {
  expect_refused({"pair", "--slave", "192.0.2.7:47021", "7KQ2-M8XH-3FZP-W0TR-9VNC-D4AB"}, "--token-file");
  const auto pair = command<PairCommand>({"pair", "--slave", "192.0.2.7:47021", "--token-file", "-"});
  EXPECT_EQ(pair.token_file, "-");
  EXPECT_FALSE(pair.list);
  EXPECT_TRUE(command<PairCommand>({"pair", "--list"}).list);
  expect_refused({"pair"}, "--slave");
  const std::vector<std::string> names = {"a", "b"};
  EXPECT_EQ(command<UnpairCommand>({"unpair", "a", "b"}).names, names);
  expect_refused({"unpair"}, "NAME");
}

TEST(CommandLine, AssignmentsComeInPairs) {
  expect_refused({"set", "slave", "a.b"}, "a.b");
  expect_refused({"set", "slave", "a.b", "1", "c.d"}, "c.d");
  expect_refused({"set", "slave"}, "PATH VALUE");
  expect_refused({"set", "moon", "a.b", "1"}, "moon");
}

TEST(CommandLine, OptionsOfAllCommandsMayStandBehindTheCommand) {
  const auto invocation =
      std::get<Invocation>(parse({"status", "--json", "--timeout", "250ms", "--slave", "robot:47020"}));
  EXPECT_TRUE(invocation.options.json);
  EXPECT_EQ(invocation.options.timeout_s, 0.25);
  EXPECT_EQ(invocation.options.slave_address, "robot:47020");
  EXPECT_EQ(invocation.options.master_address, "127.0.0.1:47010");
}

TEST(CommandLine, TakesWordsInAnyCase) {
  const auto mode = std::get<Invocation>(parse({"mode", "Rate"}));
  EXPECT_EQ(std::get<ActionCommand>(mode.command).action.mode(), proto::RATE);
  const auto get = std::get<Invocation>(parse({"get", "Slave"}));
  EXPECT_EQ(std::get<GetCommand>(get.command).side, Side::kSlave);
}

TEST(CommandLine, RefusesWhatIsOutOfRangeAndSaysTheRange) {
  expect_refused({"scale", "0.01"}, "0.05 to 1");
  expect_refused({"scale", "nan"}, "0.05 to 1");
  expect_refused({"scale", "sideways"}, "sideways");
  expect_refused({"kv", "0"}, "0.001 to 1000");
  expect_refused({"kv", "faster"}, "faster");
  expect_refused({"watch", "--hz", "0"}, "0.1 to 60");
  expect_refused({"watch", "--hz", "nan"}, "0.1 to 60");
  expect_refused({"watch", "--count", "0"}, "--count");
  expect_refused({"watch", "--count", "1.5"}, "--count");
  expect_refused({"--timeout", "0", "status"}, "0.05 to 600");
  expect_refused({"--timeout", "inf", "status"}, "--timeout");
  expect_refused({"mode", "sideways"}, "sideways");
  for (const char* address : {"nowhere", ":47010", "host:", "host:0", "host:65536", "host:x"})
    expect_refused({"--master", address, "status"}, "HOST:PORT");
  expect_refused({"--master", "", "status"}, "--master: is empty");
  expect_refused({"status", "--timeout", ""}, "--timeout: is empty");
  for (const char* address : {"foo", "127.0.0.1:99999", "::1:80"})
    expect_refused({"view", "--listen", address}, "--listen");
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  expect_refused({"dance"}, "dance is not a command");
  expect_refused({"status", "--wings"}, "--wings");
  expect_refused({"engage", "now"}, "now");
}

TEST(CommandLine, ScaleIsANumberOrAStep) {
  EXPECT_EQ(command<ScaleCommand>({"scale", "0.5"}).value, 0.5);
  EXPECT_EQ(command<ScaleCommand>({"scale", "up"}).steps, 1);
  EXPECT_EQ(command<ScaleCommand>({"scale", "down"}).steps, -1);
  EXPECT_FALSE(command<ScaleCommand>({"scale", "down"}).value.has_value());
  EXPECT_EQ(command<KvCommand>({"kv", "2.5"}).value, 2.5);
  EXPECT_EQ(command<KvCommand>({"kv", "down"}).steps, -1);
}

TEST(CommandLine, HelpOfEveryCommandHasAnExample) {
  const std::vector<std::vector<const char*>> commands{{},
                                                       {"status"},
                                                       {"watch"},
                                                       {"get"},
                                                       {"set"},
                                                       {"link"},
                                                       {"link", "show"},
                                                       {"link", "set"},
                                                       {"link", "blackout"},
                                                       {"link", "clear"},
                                                       {"mode"},
                                                       {"scale"},
                                                       {"kv"},
                                                       {"engage"},
                                                       {"adapter"},
                                                       {"adapter", "check"},
                                                       {"stop"}};
  for (auto words : commands) {
    words.push_back("--help");
    const auto printout = std::get<Printout>(parse(words));
    EXPECT_EQ(printout.exit, ExitStatus::kDone);
    EXPECT_NE(printout.text.find("Example: longreach "), std::string::npos) << printout.text;
  }
}

TEST(CommandLine, AnAdapterIsOfADeviceOrOfARobot) {
  const auto asked = [](const std::vector<const char*>& words) {
    return std::get<AdapterCheckCommand>(std::get<Invocation>(parse(words)).command);
  };
  const auto device = asked({"adapter", "check", "--device", "unix:/run/d", "--force", "2"});
  EXPECT_FALSE(device.robot);
  EXPECT_EQ(device.address, "unix:/run/d");
  EXPECT_EQ(device.force_n, 2.0);
  const auto robot = asked({"adapter", "check", "--robot", "unix:/r", "--move", "-0.01"});
  EXPECT_TRUE(robot.robot);
  EXPECT_EQ(robot.move, -0.01);
  EXPECT_THROW(parse({"adapter", "check"}), UsageError);
  EXPECT_THROW(parse({"adapter", "check", "--device", "unix:/r", "--robot", "unix:/s"}), UsageError);
  EXPECT_THROW(parse({"adapter", "check", "--device", "127.0.0.1:7"}), UsageError);
  EXPECT_THROW(parse({"adapter", "check", "--device", "unix:/r", "--force", "11"}), UsageError);
  EXPECT_THROW(parse({"adapter", "check", "--robot", "unix:/r", "--move", "nan"}), UsageError);
  const auto pushed =
      asked({"adapter", "check", "--push", "--robot", "unix:/r", "--robot-file", "f", "--patience", "2"});
  EXPECT_TRUE(pushed.push);
  EXPECT_EQ(pushed.robot_file, "f");
  EXPECT_EQ(pushed.push_timeout_s, 2.0);
  EXPECT_THROW(parse({"adapter", "check", "--push", "--robot", "unix:/r"}), UsageError);
  EXPECT_THROW(parse({"adapter", "check", "--push", "--device", "unix:/r", "--robot-file", "f"}), UsageError);
}

TEST(CommandLine, WithoutACommandItPrintsHelpAndIsBadUsage) {
  EXPECT_EQ(std::get<Printout>(parse({})).exit, ExitStatus::kUsage);
  EXPECT_EQ(std::get<Printout>(parse({"link"})).exit, ExitStatus::kUsage);
}

}  // namespace
}  // namespace longreach::command_line_test
