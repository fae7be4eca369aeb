// What is asked for is in force: random settings, for programs and for the laboratory, with and without robot, device
// and scene files and presets. What `get` shows is what was set, and it is what the nodes use.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "common/config/differences.hpp"
#include "common/config/effective.hpp"
#include "common/config/field_text.hpp"
#include "common/config/user_file.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"
#include "tests/unit/common/config/walk.hpp"

namespace longreach::settings_in_force_test {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const std::string kDeploy = LONGREACH_DEPLOY;

std::string urdf(const std::string& limits) {
  std::string text = "<robot name='arm'><link name='base'/><link name='tool0'/><link name='ee_link'/>";
  const char* axes[] = {"0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"};
  for (int i = 0; i < 6; ++i) {
    const std::string from = i == 0 ? "base" : "l" + std::to_string(i), to = "l" + std::to_string(i + 1);
    text += "<link name='" + to + "'/><joint name='j" + std::to_string(i + 1) +
            "' type='revolute'><parent link='" + from + "'/><child link='" + to +
            "'/><origin xyz='0.1 0 0.3'/><axis xyz='" + axes[i] +
            "'/><limit lower='-2.5' upper='2.5' velocity='2' effort='50' " + limits + "/></joint>";
  }
  for (const char* end : {"tool0", "ee_link"})
    text += "<joint name='to_" + std::string(end) + "' type='fixed'><parent link='l6'/><child link='" + end +
            "'/><origin xyz='0.1 0 0'/></joint>";
  return text + "</robot>";
}

/// What a run of this test chooses.
struct Choice {
  bool lab = false, slave = false;
  std::string config{};
  std::vector<std::string> files{};  // settings that name files or presets
};

/// The effective configuration of the side, and where its values come from (only of a program).
template <class Side>
struct Outcome {
  Side config;
  Origins origins;
};

template <class Side>
Outcome<Side> outcome_of(const Choice& choice, const std::vector<std::string>& settings) {
  std::vector<std::string> all = choice.files;
  all.insert(all.end(), settings.begin(), settings.end());
  if (!choice.lab) {
    const auto effective = effective_config<Side>({choice.config, "", all});
    return {effective.config, effective.origins};
  }
  for (std::string& text : all) text = (choice.slave ? "slave." : "master.") + text;
  const proto::LabConfig config = configure(all, kDeploy);
  if constexpr (std::is_same_v<Side, proto::SlaveConfig>) return {config.slave(), {}};
  if constexpr (std::is_same_v<Side, proto::MasterConfig>) return {config.master(), {}};
}

std::string text_of(const Message& message, const std::string& path) {
  const PathLookup found = find_path(message, path);
  return found.error.empty() ? value_text(holder(message, found.path), found.path.back()) : found.error;
}

/// A value in the field's range other than the present one.
std::string drawn(Random& random, const FieldDescriptor& field, const std::string& present) {
  const proto::Range& range = field.options().GetExtension(proto::range);
  const double low = range.has_min() ? range.min() : -1.0, high = range.has_max() ? range.max() : 1.0;
  const auto number = [&] {  // near the present value where there is one, else anywhere
    const double now = std::atof(present.c_str());
    const double wide = std::min(high - low, std::max(0.2 * std::abs(now), 0.01));
    return std::clamp(now + wide * (random.uniform() - 0.5), low + 1e-9, high);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return present == "true" ? "false" : "true";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto& type = *field.enum_type();
      return type.value(static_cast<int>(random.uniform() * type.value_count()) % type.value_count())->name();
    }
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(static_cast<int>(std::clamp(std::atof(present.c_str()) + 1.0, low, high)));
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    default:
      break;
  }
  std::string list = std::to_string(number());
  const int count = field.is_repeated() ? static_cast<int>(field.options().GetExtension(proto::count)) : 1;
  for (int i = 1; i < count; ++i) list += "," + std::to_string(number());
  return list;
}

/// Names of elements, files (which have their own tests) and the preset, which changes other fields.
bool left_out(const std::string& path) {
  return path.ends_with("name") || path.ends_with("_file") || path.find(".file.") != std::string::npos ||
         path == "accuracy" || path.starts_with("scene.needs") || path.ends_with("_link") ||
         path.ends_with("adapter.address") || path.ends_with("listen") || path.ends_with(".slave") ||
         path.ends_with("slave_rpc");
}

// These set a field of every joint.
std::string spread_field(const std::string& path) {
  for (const char* field : {"acceleration_max_rad_per_s2", "jerk_max_rad_per_s3", "start_rad"})
    if (path == std::string("robot.") + field) return field;
  return "";
}

struct Score {
  int tried = 0, accepted = 0;
  std::set<std::string> fields{};
};

using Assigned = std::vector<std::pair<std::string, std::string>>;  // path, value

/// One to four random fields with values.
Assigned drawn_fields(Random& random, const Message& config, bool slave) {
  const std::vector<std::string> paths = leaf_paths(config);
  Assigned chosen;
  const int count = 1 + static_cast<int>(4.0 * random.uniform()) % 4;
  while (static_cast<int>(chosen.size()) < count) {
    std::string path =
        paths[static_cast<std::size_t>(random.uniform() * static_cast<double>(paths.size())) % paths.size()];
    if (random.uniform() < 0.2 && slave)
      path = random.uniform() < 0.5 ? "robot.acceleration_max_rad_per_s2" : "robot.jerk_max_rad_per_s3";
    const auto same_part = [&](const auto& other) {  // one sets what the other sets
      return other.first == path ||
             (!spread_field(other.first).empty() && path.ends_with(spread_field(other.first))) ||
             (!spread_field(path).empty() && other.first.ends_with(spread_field(path)));
    };
    if (left_out(path) || std::ranges::any_of(chosen, same_part)) continue;
    const FieldDescriptor& field = *find_path(config, path).path.back().field;
    chosen.emplace_back(path, drawn(random, field, text_of(config, path)));
  }
  return chosen;
}

/// Checks that each field is in force; returns what may have changed.
template <class Side>
std::set<std::string> check_fields(const Outcome<Side>& before, const Outcome<Side>& after,
                                   const Assigned& chosen, bool lab) {
  const Side used = to_message(to_struct(after.config));  // what the nodes have
  std::set<std::string> expected;
  for (const auto& [path, value] : chosen) {
    Side alone = before.config;
    set_field(alone, path, value);
    const std::string wanted = text_of(alone, path),
                      index = path_by_index(find_path(after.config, path).path);
    EXPECT_EQ(get_field(after.config, path), wanted) << path;
    EXPECT_EQ(text_of(used, path), wanted) << path;
    if (!lab) {
      EXPECT_EQ(after.origins.of(index), kFromCommandLine) << path;
    }
    expected.insert(index);
    const std::string field = spread_field(path);
    for (int i = 0; i < 6 && !field.empty(); ++i) {
      const std::string joint = "robot.joint." + std::to_string(i) + "." + field;
      if (field != "start_rad") {
        EXPECT_EQ(text_of(used, joint), wanted) << joint;
      }
      expected.insert(joint);
    }
  }
  return expected;
}

/// Sets random fields and checks that each is in force, and nothing else has changed.
template <class Side>
void check(const Choice& choice, Random& random, Score& score) {
  Outcome<Side> before;
  try {
    before = outcome_of<Side>(choice, {});
  } catch (const ConfigError&) {
    return;  // files that do not fit together
  }
  const Assigned chosen = drawn_fields(random, before.config, choice.slave);
  std::vector<std::string> settings;
  for (const auto& [path, value] : chosen) settings.push_back(path + "=" + value);
  ++score.tried;
  Outcome<Side> after;
  try {
    after = outcome_of<Side>(choice, settings);
  } catch (const ConfigError&) {
    return;  // against a rule between fields, or without effect in the laboratory
  }
  ++score.accepted;
  std::string trace = choice.lab ? "lab" : "program " + choice.config;
  for (const auto& part : {choice.files, settings})
    for (const std::string& setting : part) trace += " " + setting;
  SCOPED_TRACE(trace);
  for (const auto& [path, value] : chosen) score.fields.insert(path);
  const std::set<std::string> expected = check_fields(before, after, chosen, choice.lab);
  for (const Difference& difference : differences(before.config, after.config)) {
    const std::string path = path_by_index(difference.path);
    EXPECT_TRUE(expected.contains(path)) << path << " has changed, too";
  }
}

class SettingsInForce : public testing::Test {
 protected:
  void SetUp() override { ::setenv("LONGREACH_HOME", kDeploy.c_str(), 1); }
  void TearDown() override { ::unsetenv("LONGREACH_HOME"); }

  std::string written(const std::string& name, const std::string& text) const {
    return folder.write(name, text).string();
  }
  TemporaryFolder folder;
};

TEST_F(SettingsInForce, GetShowsWhatWasSetAndTheNodesUseIt) {
  const std::string plain = written("plain.urdf", urdf("")),
                    limited = written("limited.urdf", urdf("acceleration='4' jerk='2400'"));
  const std::string slave_file = written("slave.txtpb", "playout { adaptive: false } robot { servo_hz: 12 }");
  const std::string master_file = written("master.txtpb", "rendering { ke: 0.9 } device { turns: false }");
  const std::vector<std::string> robots{"", "robots/ur5e.txtpb", plain, limited};
  const std::vector<std::string> scenes{"", "scenes/wall.txtpb", "scenes/dock.txtpb"};
  const std::vector<std::string> devices{"", "devices/falcon.txtpb"};
  const std::vector<std::string> presets{"", "FAST", "EXACT"};
  Random random(20261128);
  const auto one_of = [&](const std::vector<std::string>& all) {
    return all[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size())) % all.size()];
  };
  const auto name = [&](Choice& choice, const std::string& field, const std::string& value) {
    if (!value.empty()) choice.files.push_back(field + "=" + value);
  };
  Score score;
  for (int n = 0; n < 600; ++n) {
    Choice choice{random.uniform() < 0.5, random.uniform() < 0.7};
    if (choice.slave) {
      const std::string robot = one_of(robots);
      name(choice, "robot_file", robot);
      if (robot.ends_with(".urdf")) name(choice, "robot.tip_link", one_of({"tool0", "ee_link"}));
      name(choice, "scene_file", one_of(scenes));
    } else {
      name(choice, "device_file", one_of(devices));
    }
    // In the laboratory both sides need the same rate.
    if (!choice.lab) name(choice, "accuracy", one_of(presets));
    if (!choice.lab && random.uniform() < 0.3) choice.config = choice.slave ? slave_file : master_file;
    if (choice.slave) check<proto::SlaveConfig>(choice, random, score);
    if (!choice.slave) check<proto::MasterConfig>(choice, random, score);
    if (HasFailure()) break;
  }
  EXPECT_GT(score.accepted, score.tried / 3);
  EXPECT_GT(score.fields.size(), 150u);
}

// The files are read with the links and limits that are set, also if these follow on the command line.
TEST_F(SettingsInForce, LinksAndLimitsApplyToAUrdf) {
  const std::string file = "robot_file=" + written("arm.urdf", urdf(""));
  const std::vector<std::string> settings{file, "robot.acceleration_max_rad_per_s2=0.05",
                                          "robot.jerk_max_rad_per_s3=30", "robot.tip_link=ee_link"};
  const auto program = effective_config<proto::SlaveConfig>({"", "", settings});
  const proto::LabConfig lab = configure(settings, kDeploy);
  for (const proto::Robot& robot : {program.config.robot(), lab.slave().robot()}) {
    EXPECT_EQ(robot.tip_link(), "ee_link");
    for (const proto::Joint& joint : robot.joint()) {
      EXPECT_EQ(joint.acceleration_max_rad_per_s2(), 0.05);
      EXPECT_EQ(joint.jerk_max_rad_per_s3(), 30.0);
    }
  }
  EXPECT_EQ(program.origins.of("robot.joint.3.acceleration_max_rad_per_s2"), kFromCommandLine);
  EXPECT_NE(error_of([&] {
              (void)effective_config<proto::SlaveConfig>({"", "", {file}});
            }).find("name the tool in robot.tip_link"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              (void)effective_config<proto::SlaveConfig>({"", "", {"robot.tip_link=ee_link"}});
            }).find("robot.tip_link = \"ee_link\" has no effect, because "),
            std::string::npos);
}

// longreach-slave does not simulate in MuJoCo; what it is asked for is not replaced by another robot.
TEST_F(SettingsInForce, ASlaveRefusesARobotOfMuJoCoAndSaysWhatToRun) {
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{"robot.mjcf=mujoco/scenes/wall.xml"},
        std::vector<std::string>{"robot.mjcf=mujoco/scenes/wall.xml", "robot_adapter.address=unix:/robot"}}) {
    const std::string said = error_of([&] {
      (void)effective_config<proto::SlaveConfig>({"", "", settings});
    });
    for (const char* words : {"robot.mjcf = ", "wall.xml: only longreach-lab", "run `longreach-mujoco ",
                              "set robot_adapter.address = unix:/PATH"})
      EXPECT_NE(said.find(words), std::string::npos) << said;
  }
  const std::string file =
      written("arm.txtpb", read_user_file(std::filesystem::path(kDeploy) / "robots" / "space_arm.txtpb") +
                               "mjcf: \"scene.xml\"\n");
  EXPECT_NE(error_of([&] {
              (void)effective_config<proto::SlaveConfig>({"", "", {"robot_file=" + file}});
            }).find(file + ": mjcf is not a property of a robot file"),
            std::string::npos);
}

// A limit of the file replaces the default; one that a person sets wins, and a looser one is mentioned.
TEST_F(SettingsInForce, LimitsOfAUrdfReplaceDefaultsAndPersonsWin) {
  const std::string path = written("arm.urdf", urdf("acceleration='4' deceleration='3' jerk='2000'"));
  const std::vector<std::string> settings{"robot_file=" + path, "robot.tip_link=tool0",
                                          "command.speed_max_m_per_s=0.01"};
  const auto plain = effective_config<proto::SlaveConfig>({"", "", settings});
  EXPECT_EQ(plain.config.robot().joint(2).acceleration_max_rad_per_s2(), 3.0) << "the smaller of both";
  EXPECT_EQ(plain.config.robot().joint(2).jerk_max_rad_per_s3(), 2000.0);
  EXPECT_EQ(plain.origins.of("robot.joint.2.jerk_max_rad_per_s3"), "robot file " + path);
  auto looser = settings;
  looser.emplace_back("robot.acceleration_max_rad_per_s2=4");
  const auto set = effective_config<proto::SlaveConfig>({"", "", looser});
  EXPECT_EQ(set.config.robot().joint(2).acceleration_max_rad_per_s2(), 4.0);
  EXPECT_NE(
      std::ranges::find(set.warnings,
                        "robot.joint.j1.acceleration_max_rad_per_s2 = 4 is looser than the limit of the "
                        "robot file, 3, as for 5 other joints (" +
                            path + ")"),
      set.warnings.end())
      << testing::PrintToString(set.warnings);
  auto tighter = settings;
  tighter.emplace_back("robot.acceleration_max_rad_per_s2=2.9");
  for (const std::string& warning : effective_config<proto::SlaveConfig>({"", "", tighter}).warnings)
    EXPECT_EQ(warning.find("looser"), std::string::npos) << warning;
}

// The command line is above the configuration file, also where that contains a whole robot or scene.
TEST_F(SettingsInForce, FilesOfTheCommandLineReplaceContentsOfTheConfiguration) {
  const auto first = effective_config<proto::SlaveConfig>({"", "", {"robot_file=robots/ur5e.txtpb"}});
  const std::string config = written("slave.txtpb", get_field(first.config, ""));
  const auto again = effective_config<proto::SlaveConfig>({config, "", {}});
  EXPECT_EQ(again.config.robot().name(), first.config.robot().name());
  EXPECT_EQ(again.origins.of("robot.joint.0.d_m"), "configuration file " + config);
  const auto other = effective_config<proto::SlaveConfig>(
      {config, "", {"robot_file=robots/irb120.txtpb", "scene_file=scenes/dock.txtpb"}});
  EXPECT_NE(other.config.robot().name(), first.config.robot().name());
  EXPECT_NE(other.config.scene().name(), first.config.scene().name());
}

TEST_F(SettingsInForce, OriginsNameEverySource) {
  const std::string config = written("slave.txtpb", "command { force_guard_n: 15 }");
  const auto slave = effective_config<proto::SlaveConfig>(
      {config, "moon", {"accuracy=FAST", "robot_file=robots/ur5e.txtpb", "estimator.deadband=0.2"}});
  const auto origin = [&](const std::string& path) { return slave.origins.of(path); };
  EXPECT_EQ(origin("command.force_guard_n"), "configuration file " + config);
  EXPECT_EQ(origin("link.impairment.delay_s"), "link profile moon");
  EXPECT_EQ(origin("loop.rate_hz"), "preset FAST");
  EXPECT_EQ(origin("estimator.deadband"), "command line");
  EXPECT_EQ(origin("robot.joint.1.a_m"), "robot file " + kDeploy + "/robots/ur5e.txtpb");
  EXPECT_EQ(origin("scene.surface.0.material"), "scene file " + kDeploy + "/scenes/wall.txtpb");
  EXPECT_EQ(origin("command.give_way_m"), "default");
  EXPECT_EQ(get_field_with_origins(slave.config, "estimator.deadband", nullptr, slave.origins),
            "0.2  # command line");
  proto::SlaveConfig changed = slave.config;
  changed.mutable_estimator()->set_deadband(0.3);
  EXPECT_EQ(with_clients(slave.origins, slave.config, changed).of("estimator.deadband"), "client");
  const std::string text = check_text(slave, "");
  EXPECT_NE(text.find("\n  force_guard_n: 15  # configuration file " + config + "; may be set: 15 or less\n"),
            std::string::npos)
      << text;
  proto::SlaveConfig read;
  load_text("check", text, read);  // what is printed is a configuration file
  EXPECT_EQ(read.robot().joint_size(), 6);
}

TEST_F(SettingsInForce, SettingsWithoutEffectAreMentionedOrRefused) {
  const auto slave = effective_config<proto::SlaveConfig>({"", "", {"estimator.exponent=1.5"}});
  const std::string sentence =
      "estimator.exponent has no effect, because estimator.kind is not FIXED_EXPONENT: the exponent is identified";
  EXPECT_EQ(slave.warnings, std::vector<std::string>{sentence});
  EXPECT_EQ(error_of([] { (void)configure({"estimator.exponent=1.5"}, kDeploy); }), sentence);
  EXPECT_EQ(error_of([] {
              (void)configure({"estimator.exponent=1.5", "estimator.kind=FIXED_EXPONENT"}, kDeploy);
            }),
            "no error");
  const auto real = effective_config<proto::SlaveConfig>(
      {"",
       "",
       {"robot_adapter.address=unix:/x", "scene_file=scenes/dock.txtpb", "robot.joint.0.start_rad=0.1"}});
  EXPECT_EQ(real.warnings.size(), 2u) << testing::PrintToString(real.warnings);
  const auto master = effective_config<proto::MasterConfig>({"", "", {"safety.presence_s=1"}});
  EXPECT_EQ(master.warnings,
            std::vector<std::string>{"safety.presence_s has no effect, because safety.presence is not HOLD"});
}

}  // namespace
}  // namespace longreach::settings_in_force_test
