#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/common/config/error_of.hpp"

namespace longreach::violation_test {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

template <class Message>
std::string validation_error(const Message& message) {
  return error_of([&] { validate(message); });
}

TEST(Validation, AcceptsTheEndsOfARangeAndNothingBeyond) {
  proto::Mapping mapping;
  for (const double scale : {0.05, 1.0}) {
    mapping.set_scale(scale);
    EXPECT_EQ(validation_error(mapping), "no error");
  }
  mapping.set_scale(std::nextafter(0.05, 0.0));
  EXPECT_EQ(validation_error(mapping), "scale = 0.049999999999999996 is outside 0.05 to 1");
  mapping.set_scale(std::nextafter(1.0, 2.0));
  EXPECT_EQ(validation_error(mapping), "scale = 1.0000000000000002 is outside 0.05 to 1");
  for (const double scale : {-1.0, 0.0, 1e-9, 1e9, 5e-324}) {
    mapping.set_scale(scale);
    EXPECT_TRUE(validation_error(mapping).ends_with(" is outside 0.05 to 1")) << scale;
  }
}

TEST(Validation, LeavesRealDevicesAndRobotsToThePrograms) {
  proto::LabConfig lab;
  lab.mutable_master()->mutable_device_adapter()->set_silence_s(0.1);
  EXPECT_EQ(validation_error(lab), "no error");
  lab.mutable_slave()->mutable_robot_adapter()->set_address("unix:/r");
  EXPECT_EQ(validation_error(lab),
            "slave.robot_adapter.address = unix:/r applies only to longreach-master and longreach-slave; the "
            "laboratory simulates devices and robots");
  lab.mutable_master()->mutable_device_adapter()->set_address("unix:/d");
  EXPECT_TRUE(validation_error(lab).starts_with("master.device_adapter.address = unix:/d applies only to"));
  EXPECT_EQ(validation_error(lab.master()), "no error");
}

TEST(Validation, LeavesTheComparisonLawsToTheLaboratory) {
  proto::LabConfig lab;
  proto::MasterConfig& program = *lab.mutable_master();
  for (int i = 0; i < proto::Rendering::Law_ARRAYSIZE; ++i) {
    const auto law = static_cast<proto::Rendering::Law>(i);
    const std::string name = proto::Rendering::Law_Name(law);
    program.mutable_rendering()->set_law(law);
    EXPECT_EQ(validation_error(lab), "no error") << name;
    EXPECT_EQ(
        validation_error(program),
        name == "STIFFNESS"
            ? "no error"
            : "rendering.law = " + name +
                  " is for comparison and available only in longreach-lab; leave it out or set STIFFNESS");
  }
}

TEST(Validation, ExcludesALowerEndThatIsMarkedAbove) {
  proto::Sensing sensing;
  sensing.set_release_nm(0.0);
  EXPECT_EQ(validation_error(sensing), "release_nm = 0 is outside 0 (excluded) to 100");
  sensing.set_release_nm(5e-324);
  EXPECT_EQ(validation_error(sensing), "no error");
}

TEST(Validation, RefusesNumbersThatAreNotFiniteEvenWithoutARange) {
  proto::SlaveConfig config;
  auto& plane = *config.mutable_scene()->add_surface()->mutable_plane();
  for (const double x : {0.0, std::numeric_limits<double>::infinity(), 1.0}) plane.add_point_m(x);
  EXPECT_EQ(validation_error(config), "scene.surface.0.plane.point_m.1 = inf is not a finite number");
  plane.set_point_m(1, std::nan(""));
  EXPECT_EQ(validation_error(config), "scene.surface.0.plane.point_m.1 = nan is not a finite number");
}

TEST(Validation, RefusesEnumValuesAndFieldsThatTheSchemaDoesNotKnow) {
  proto::MasterConfig config;
  const auto mode_7 = std::string("\x32\x02\x08\x07", 4);  // field 6 (mapping), length 2: field 1 (mode) = 7
  ASSERT_TRUE(config.ParseFromString(mode_7));
  EXPECT_EQ(validation_error(config), "mapping.mode = 7 is not one of RATE, POSITION");
  const auto field_99 = std::string("\x32\x03\x98\x06\x01", 5);  // mapping: field 99 = 1
  ASSERT_TRUE(config.ParseFromString(field_99));
  EXPECT_EQ(validation_error(config), "mapping has the field number 99, which is unknown to this version");
  ASSERT_TRUE(config.ParseFromString(std::string("\x98\x06\x01", 3)));
  EXPECT_EQ(validation_error(config), "field number 99 is unknown to this version");
}

TEST(Validation, CountsListsOnlyWhenTheyAreGiven) {
  proto::Operator script;
  EXPECT_EQ(validation_error(script), "no error");
  for (int i = 0; i < 4; ++i) script.add_direction(1.0);
  EXPECT_EQ(validation_error(script), "direction has 4 elements; 3 are needed");
}

TEST(Validation, RefusesDirectionsThatPointNowhere) {
  proto::MasterConfig config;
  auto& direction = *config.mutable_operator_()->mutable_direction();
  const auto error_with = [&](double x, double y, double z) {
    direction.Clear();
    for (const double v : {x, y, z}) direction.Add(v);
    return validation_error(config);
  };
  EXPECT_EQ(error_with(0, 0, 0),
            "operator.direction has length 0, which is outside the range 1e-9 to 1e9, so it does not "
            "define a direction");
  EXPECT_NE(error_with(0, 1e-320, 0), "no error");
  EXPECT_NE(error_with(1e300, 1e300, 0), "no error");
  EXPECT_EQ(error_with(0, -1e-9, 0), "no error");
  EXPECT_EQ(error_with(3, 4, 0), "no error");
}

TEST(Validation, WantsTheDeadZoneInsideTheRadius) {
  proto::Mapping mapping;
  mapping.set_dead_zone_m(0.05);
  EXPECT_EQ(validation_error(mapping), "dead_zone_m = 0.05 is not below radius_max_m = 0.05");
  mapping.set_radius_max_m(0.06);
  EXPECT_EQ(validation_error(mapping), "no error");
  mapping.set_radius_max_rad(0.02);
  EXPECT_EQ(validation_error(mapping), "radius_max_rad = 0.02 is not above dead_zone_rad = 0.05");
}

proto::Robot six_joints() {
  proto::Robot robot;
  for (int i = 0; i < 6; ++i) robot.add_joint()->set_a_m(1.0);
  return robot;
}

TEST(Validation, WantsJointLimitsInOrderAndTheStartBetweenThem) {
  proto::Robot robot = six_joints();
  EXPECT_EQ(validation_error(robot), "no error");
  robot.mutable_joint(2)->set_min_rad(1.0);
  robot.mutable_joint(2)->set_max_rad(1.0);
  EXPECT_EQ(validation_error(robot), "joint.2.min_rad = 1 is not below max_rad = 1");
  robot.mutable_joint(2)->set_max_rad(2.0);
  EXPECT_EQ(validation_error(robot), "joint.2.start_rad = 0 is outside the joint's limits 1 to 2");
  robot.mutable_joint(2)->set_start_rad(2.0);
  EXPECT_EQ(validation_error(robot), "no error");
}

proto::Scene one_wall() {
  proto::Scene scene;
  scene.add_material()->set_name("steel");
  scene.add_surface()->set_name("front");
  scene.mutable_surface(0)->set_material("steel");
  scene.mutable_surface(0)->mutable_plane();
  return scene;
}

TEST(Validation, WantsOneShapeForEachSurface) {
  proto::Scene scene = one_wall();
  scene.mutable_surface(0)->clear_plane();
  scene.mutable_surface(0)->mutable_movement();  // is none
  EXPECT_EQ(validation_error(scene),
            "surface.front has no shape; give it a plane, sphere, box, cylinder or hinge");
  scene.mutable_surface(0)->mutable_sphere();
  EXPECT_EQ(validation_error(scene), "no error");
  scene.mutable_surface(0)->mutable_hinge();
  EXPECT_EQ(validation_error(scene),
            "surface.front.hinge cannot be combined with sphere; a surface has only one shape");
}

TEST(Validation, WantsOneMaterialForABody) {
  proto::Scene scene = one_wall();
  scene.add_material()->set_name("foam");
  *scene.add_surface() = scene.surface(0);
  scene.mutable_surface(0)->set_body("step");
  scene.mutable_surface(1)->set_name("top");
  scene.mutable_surface(1)->set_body("step");
  EXPECT_EQ(validation_error(scene), "no error");
  scene.mutable_surface(1)->set_material("foam");
  EXPECT_EQ(
      validation_error(scene),
      "surface.top.material = \"foam\" differs from the material \"steel\" of the body \"step\"; a body "
      "has only one material");
  scene.mutable_surface(0)->clear_body();
  EXPECT_EQ(validation_error(scene), "no error");
}

TEST(Validation, AcceptsTheNeedsOfOldSceneFiles) {
  proto::Scene scene = one_wall();
  scene.mutable_needs()->set_rotation(true);
  EXPECT_EQ(validation_error(scene), "no error");
}

TEST(Validation, WantsABudgetThatFiftyCommandsASecondFitIn) {
  proto::MasterConfig master;
  master.mutable_link()->set_budget_kbit_per_s(51.9);
  EXPECT_EQ(validation_error(master),
            "link.budget_kbit_per_s = 51.9 is neither 0 (no limit) nor at least 52");
  master.mutable_link()->set_budget_kbit_per_s(52.0);
  EXPECT_EQ(validation_error(master), "no error");
}

TEST(Validation, WantsAddressesThatAreSuchByTheirForm) {
  const auto said = [](const std::string& text) {
    proto::MasterConfig master;
    master.mutable_link()->set_slave(text);
    return validation_error(master);
  };
  for (const char* address : {"127.0.0.1:47001", "[::1]:0", "robot.local:65535"})
    EXPECT_EQ(said(address), "no error");
  for (const char* text : {"", ":", "foo", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1", ":1",
                           "127.0.0.1:1x", "::1:1", "[]:1", "[::1:1", "127.0.0.1: 1"})
    EXPECT_TRUE(said(text).starts_with("link.slave = \"" + std::string(text) + "\" is not an address; write"))
        << said(text);
  proto::MasterConfig master;
  master.mutable_rpc()->set_listen("");  // the default
  master.mutable_device_adapter()->set_address("");
  master.mutable_link()->set_slave_rpc("");
  EXPECT_EQ(validation_error(master), "no error");
  master.mutable_device_adapter()->set_address("foo");
  EXPECT_TRUE(validation_error(master).starts_with(
      "device_adapter.address = foo is not an adapter address: write unix:/PATH"));
  proto::SlaveConfig slave;
  slave.mutable_rpc()->set_listen("foo");
  EXPECT_TRUE(validation_error(slave).starts_with("rpc.listen = \"foo\""));
}

TEST(Validation, WantsTextsInUtf8) {
  proto::Scene scene = one_wall();
  scene.set_name("w\xC3\xA4ll");
  EXPECT_EQ(validation_error(scene), "no error");
  for (const char* text : {"w\xE4ll", "\xC3", "\xED\xA0\x80", "\xC0\xAF", "\xF4\x90\x80\x80"}) {
    scene.set_name(text);
    EXPECT_NE(validation_error(scene).find("\" is not UTF-8: "), std::string::npos)
        << validation_error(scene);
  }
}

TEST(Validation, WantsAWayToHaveTwoEnds) {
  proto::Scene scene = one_wall();
  scene.mutable_path()->add_waypoint();
  EXPECT_EQ(validation_error(scene), "path.waypoint has 1 elements; a path needs at least two");
}

TEST(Validation, WantsNamesThatAreThereAndAreTheirOwn) {
  proto::Scene scene = one_wall();
  EXPECT_EQ(validation_error(scene), "no error");
  scene.mutable_surface(0)->set_material("stel");
  EXPECT_EQ(validation_error(scene),
            "surface.front.material = \"stel\" is not a material of the scene; did you mean \"steel\"? It "
            "has: steel");
  scene.mutable_surface(0)->clear_material();
  EXPECT_EQ(validation_error(scene),
            "surface.front.material = \"\" is not a material of the scene; it has: steel");

  scene = one_wall();
  scene.add_material()->set_name("steel");
  EXPECT_EQ(validation_error(scene), "material.1.name = \"steel\" is already the name of another material");
  scene.mutable_material(1)->clear_name();
  EXPECT_EQ(validation_error(scene), "material.1.name is empty; every material needs a name");
  scene.mutable_material(1)->set_name("a.b");
  EXPECT_EQ(validation_error(scene),
            "material.a.b.name = \"a.b\" cannot be used in a path; a name needs at least one letter and "
            "must not contain \".\" or \"=\"");
  scene.mutable_material(1)->set_name("12");
  EXPECT_NE(validation_error(scene), "no error");

  scene = one_wall();
  *scene.add_surface() = scene.surface(0);
  EXPECT_EQ(validation_error(scene), "surface.1.name = \"front\" is already the name of another surface");
}

// Laws of the schema itself, over every field of a side: a number without a range would let anything in.
void check_schema(const Descriptor& type) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (field.message_type() != nullptr) {
      check_schema(*field.message_type());
      continue;
    }
    const bool number = field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                        field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32;
    if (!number || field.is_repeated()) continue;
    const proto::Range& range = field.options().GetExtension(proto::range);
    const double value = field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ? field.default_value_double()
                                                                             : field.default_value_uint32();
    EXPECT_TRUE(range.has_min() && range.has_max() && range.min() < range.max()) << field.full_name();
    EXPECT_TRUE(value >= range.min() && value <= range.max() && !(range.above() && value == range.min()))
        << field.full_name();
  }
}

TEST(Schema, GivesEveryNumberARangeThatHoldsItsDefault) {
  check_schema(*proto::LabConfig::descriptor());
  check_schema(*proto::LinkProfile::descriptor());
}

TEST(Schema, HasDefaultsThatAgreeWithEachOther) {
  EXPECT_EQ(validation_error(to_message(MasterConfig{})), "no error");
  SlaveConfig slave;
  for (JointConfig& joint : slave.robot.joint) joint.a_m = 1.0;  // there is no robot by default
  EXPECT_EQ(validation_error(to_message(slave)), "no error");
}

}  // namespace
}  // namespace longreach::violation_test
