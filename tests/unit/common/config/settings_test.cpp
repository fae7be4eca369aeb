#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <tuple>

#include "common/text/number_text.hpp"
#include "master/mapping/gain_steps.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"
#include "tests/unit/common/config/walk.hpp"

namespace longreach::settings_test {
namespace {

using google::protobuf::Message;

proto::SlaveConfig slave_with_wall() {
  proto::SlaveConfig config;
  config.mutable_scene()->add_material()->set_name("floor");
  config.mutable_scene()->add_material()->set_name("wall");
  for (int i = 0; i < 6; ++i) config.mutable_robot()->add_joint()->set_a_m(1.0);
  return config;
}

// The error; the message must then be as it was.
std::string set_error(const Message& original, const std::string& path, const std::string& value) {
  const std::unique_ptr<Message> message(original.New());
  message->CopyFrom(original);
  const std::string error = error_of([&] { set_field(*message, path, value); });
  if (error != "no error") {
    EXPECT_EQ(message->SerializeAsString(), original.SerializeAsString()) << path;
  }
  return error;
}

const proto::MasterConfig kMaster{};

TEST(SetField, SetsEachTypeFromText) {
  proto::MasterConfig config;
  set_field(config, "mapping.scale", "0.25");
  set_field(config, "mapping.mode", "rate");
  set_field(config, "loop.priority", "0");
  set_field(config, "loop.lock_memory", "Off");
  set_field(config, "link.slave", "10.0.0.2:47001 = as is ");
  set_field(config, "operator.direction", "0, -1,1e-3");
  EXPECT_EQ(config.mapping().scale(), 0.25);
  EXPECT_EQ(config.mapping().mode(), proto::RATE);
  EXPECT_EQ(config.loop().priority(), 0U);
  EXPECT_FALSE(config.loop().lock_memory());
  EXPECT_EQ(config.link().slave(), "10.0.0.2:47001 = as is ");
  EXPECT_EQ(get_field(config, "operator.direction"), "0, -1, 0.001");
  set_field(config, "operator.direction", " [1, 0, 0] ");  // as --check prints it
  EXPECT_EQ(get_field(config, "operator.direction"), "1, 0, 0");
  set_field(config, "operator.direction", "[]");
  EXPECT_EQ(config.operator_().direction_size(), 0);
  EXPECT_THROW(set_field(config, "operator.direction", "[1, 0, 0"), ConfigError);
  set_field(config, "operator.direction", "");
  EXPECT_EQ(config.operator_().direction_size(), 0);
}

TEST(SetField, AddressesElementsByNameAndByIndex) {
  proto::SlaveConfig config = slave_with_wall();
  set_field(config, "scene.material.wall.exponent", "1.5");
  set_field(config, "scene.material.0.exponent", "2");
  set_field(config, "robot.joint.5.a_m", "0.3");
  EXPECT_EQ(config.scene().material(1).exponent(), 1.5);
  EXPECT_EQ(config.scene().material(0).exponent(), 2.0);
  EXPECT_EQ(config.robot().joint(5).a_m(), 0.3);
}

TEST(SetField, TakesUnitsWhereTheFieldHasThem) {
  proto::MasterConfig config;
  set_field(config, "link.impairment.delay_s", "650ms");
  set_field(config, "link.impairment.jitter_s", "20us");
  set_field(config, "link.impairment.loss", "2%");
  EXPECT_EQ(config.link().impairment().delay_s(), 0.65);
  EXPECT_EQ(config.link().impairment().jitter_s(), 2e-5);
  EXPECT_EQ(config.link().impairment().loss(), 0.02);
  // Ends in _s, but is no time; at most 1, but no fraction.
  EXPECT_EQ(set_error(kMaster, "mapping.kv_per_s", "2ms"),
            "mapping.kv_per_s = \"2ms\" is not a finite decimal number");
  EXPECT_EQ(set_error(kMaster, "device.delta.workspace_m", "2%"),
            "device.delta.workspace_m = \"2%\" is not a finite decimal number");
  EXPECT_EQ(set_error(kMaster, "link.impairment.delay_s", "2%"),
            "link.impairment.delay_s = \"2%\" is not a finite decimal number (in seconds, or followed by s, "
            "ms or us)");
  EXPECT_EQ(set_error(kMaster, "link.impairment.loss", "2ms"),
            "link.impairment.loss = \"2ms\" is not a finite decimal number (plain, or followed by %)");
}

TEST(SetField, RefusesTextThatIsNotAValueOfTheType) {
  for (const char* text : {"", "abc", "nan", "inf", "0x1", "1e999", "0.5 ", " 0.5", "0.5x", "+0.5", "0,5"}) {
    EXPECT_EQ(set_error(kMaster, "mapping.kv_per_s", text),
              "mapping.kv_per_s = \"" + std::string(text) + "\" is not a finite decimal number");
  }
  for (const char* text : {"", "-1", "1.0", "1e1", "4294967296", "0x10"}) {
    EXPECT_EQ(set_error(kMaster, "loop.priority", text),
              "loop.priority = \"" + std::string(text) + "\" is not a whole number from 0 to 4294967295");
  }
  for (const char* text : {"", "2", "yes", "truee"}) {
    EXPECT_EQ(set_error(kMaster, "loop.lock_memory", text),
              "loop.lock_memory = \"" + std::string(text) + "\" is neither true (1, on) nor false (0, off)");
  }
  for (const char* text : {"", "0", "FAST", "RATE "}) {
    EXPECT_EQ(set_error(kMaster, "mapping.mode", text),
              "mapping.mode = \"" + std::string(text) + "\" is not one of RATE, POSITION");
  }
  EXPECT_EQ(set_error(kMaster, "operator.direction", "1,,0"),
            "operator.direction.1 = \"\" is not a finite decimal number");
  EXPECT_EQ(set_error(kMaster, "operator.direction", "1,0"),
            "operator.direction has 2 elements; 3 are needed");
  std::string long_list = "1";
  for (int i = 0; i < 5000; ++i) long_list += ",1";
  EXPECT_EQ(set_error(kMaster, "operator.direction", long_list),
            "operator.direction has more than 1000 numbers");
}

TEST(SetField, RefusesValuesOutOfRange) {
  EXPECT_EQ(set_error(kMaster, "mapping.scale", "7"), "mapping.scale = 7 is outside 0.05 to 1");
  EXPECT_EQ(set_error(slave_with_wall(), "scene.material.wall.exponent", "4"),
            "scene.material.wall.exponent = 4 is outside 1 to 3");
  EXPECT_EQ(set_error(kMaster, "rendering.stiffness_max_n_per_m", "1e6"),
            "rendering.stiffness_max_n_per_m = 1000000 is outside 1 to 100000");
}

// Keys and buttons change these gains, and know no schema.
TEST(SetField, RefusesWhatStepsOfAGainDoNotReach) {
  for (const auto& [field, least, most] : {std::tuple{"mapping.scale", kScaleStep, kScaleMost},
                                           {"mapping.kv_per_s", kKvMin_per_s, kKvMax_per_s},
                                           {"mapping.kv_rotation_per_s", kKvMin_per_s, kKvMax_per_s}}) {
    EXPECT_EQ(set_error(kMaster, field, format_number(least)), "no error");
    EXPECT_EQ(set_error(kMaster, field, format_number(most)), "no error");
    EXPECT_NE(set_error(kMaster, field, format_number(0.99 * least)), "no error");
    EXPECT_NE(set_error(kMaster, field, format_number(1.01 * most)), "no error");
  }
}

TEST(SetField, LeadsFromAWrongPathToARightOne) {
  const std::string fields =
      "mode, scale, rate_law, kv_per_s, kv_rotation_per_s, dead_zone_m, dead_zone_rad, radius_max_m, "
      "radius_max_rad, "
      "speed_max_m_per_s, speed_max_rad_per_s, base_rotation_rad, goal_follows_force, rate_centre, simultaneous";
  EXPECT_EQ(set_error(kMaster, "mapping.scle", "1"),
            "mapping has no field \"scle\"; did you mean \"scale\"? It has: " + fields);
  EXPECT_EQ(set_error(kMaster, "mapping.", "1"), "mapping has no field \"\"; it has: " + fields);
  EXPECT_EQ(set_error(kMaster, "mapping", "1"), "mapping is a group; set one of its fields: " + fields);
  EXPECT_EQ(
      set_error(kMaster, "maping.scale", "1"),
      "there is no field \"maping\"; did you mean \"mapping\"? The fields are: link, loop, device_file, "
      "device, hand, "
      "operator, "
      "mapping, rendering, safety, rpc, accuracy, device_adapter");
  EXPECT_TRUE(set_error(kMaster, "", "1").starts_with("there is no field \"\"; the fields are: link, "));
  EXPECT_EQ(set_error(kMaster, "mapping.scale.x", "1"),
            "mapping.scale is a single value and has no field \"x\"");
  EXPECT_EQ(set_error(slave_with_wall(), "scene.material.wal.exponent", "1"),
            "scene.material has no element \"wal\"; did you mean \"wall\"? It has: floor, wall");
  EXPECT_EQ(set_error(slave_with_wall(), "robot.joint.6.a_m", "1"),
            "robot.joint has no element \"6\"; it has: 0, 1, 2, 3, 4, 5");
  EXPECT_TRUE(set_error(slave_with_wall(), "robot.joint.-1.a_m", "1")
                  .starts_with("robot.joint has no element \"-1\""));
  EXPECT_EQ(set_error(proto::SlaveConfig{}, "scene.material.wall.exponent", "1"),
            "scene.material has no element \"wall\"; it has: none");
  EXPECT_EQ(set_error(slave_with_wall(), "scene.material", "1"),
            "scene.material is a list; set a field of one of its elements, scene.material.NAME.FIELD or "
            "scene.material.INDEX.FIELD, where FIELD is one of: name, stiffness_n_per_m, reference_depth_m, "
            "exponent, damping_s_per_m");
  EXPECT_TRUE(set_error(slave_with_wall(), "scene.material.wall", "1")
                  .starts_with("scene.material.wall is a group; "));
}

TEST(GetField, PrintsDefaultsOfWhatIsNotSet) {
  proto::MasterConfig config;
  config.mutable_rendering()->set_ke(0.5);
  EXPECT_EQ(get_field(config, "mapping.scale"), "0.8");
  EXPECT_EQ(get_field(config, "mapping.mode"), "POSITION");
  EXPECT_EQ(get_field(config, "loop.lock_memory"), "true");
  EXPECT_EQ(get_field(config, "loop"), "rate_hz: 1000\npriority: 50\nlock_memory: true\n");
  EXPECT_TRUE(
      get_field(config, "rendering").starts_with("law: STIFFNESS\nke: 0.5\ncontact_damping_n_s_per_m: 3\n"));
  EXPECT_NE(get_field(config, "").find("hand {\n  grip: LIGHT\n}\n"), std::string::npos);
  EXPECT_EQ(get_field(slave_with_wall(), "scene.material.wall.name"), "wall");
  EXPECT_TRUE(get_field(slave_with_wall(), "scene.material").starts_with("material {\n  name: \"floor\"\n"));
  EXPECT_TRUE(
      error_of([&] { get_field(config, "mapping.scle"); }).starts_with("mapping has no field \"scle\""));
}

TEST(GetField, PrintsTextThatLoadsAgain) {
  const TemporaryFolder folder;
  proto::SlaveConfig config;
  config.set_scene_file("a\"b\\c\n");
  proto::SlaveConfig loaded;
  load_text_file(folder.write("a.txtpb", get_field(config, "")), loaded);
  EXPECT_EQ(get_field(loaded, ""), get_field(config, ""));
  EXPECT_FALSE(loaded.has_scene());  // it would hide the scene's file

  proto::MasterConfig master = to_message(MasterConfig{});
  proto::MasterConfig again;
  load_text_file(folder.write("b.txtpb", get_field(master, "")), again);
  EXPECT_EQ(again.SerializeAsString(), master.SerializeAsString());
}

// The whole schema through its own text: every leaf can be set, and what is read sets the same.
TEST(SetField, TakesBackWhatGetFieldPrints) {
  proto::LabConfig filled;
  fill_distinct(filled);
  proto::LabConfig copy = filled;
  const std::vector<std::string> paths = leaf_paths(filled);
  EXPECT_GT(paths.size(), 150U);
  for (const std::string& path : paths) {
    ASSERT_EQ(error_of([&] { set_field(copy, path, get_field(filled, path)); }), "no error") << path;
  }
  EXPECT_EQ(copy.SerializeAsString(), filled.SerializeAsString());
}

}  // namespace
}  // namespace longreach::settings_test
