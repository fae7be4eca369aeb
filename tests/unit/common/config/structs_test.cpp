#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "common/config/config.hpp"
#include "tests/unit/common/config/walk.hpp"

namespace longreach::structs_test {
namespace {

using google::protobuf::Message;

std::string difference(const Message& a, const Message& b) {
  std::string report;
  google::protobuf::util::MessageDifferencer differencer;
  differencer.ReportDifferencesToString(&report);
  return differencer.Compare(a, b) ? "" : report;
}

// A message with every leaf set to something of its own is the oracle for a forgotten field.
TEST(Structs, ForgetNoField) {
  const auto master = distinct<proto::MasterConfig>();
  EXPECT_EQ(difference(master, to_message(to_struct(master))), "");
  auto slave = distinct<proto::SlaveConfig>();
  slave.mutable_scene()->clear_needs();  // has no effect
  EXPECT_EQ(difference(slave, to_message(to_struct(slave))), "");
  const auto impairment = distinct<proto::Impairment>();
  EXPECT_EQ(difference(impairment, to_message(to_struct(impairment))), "");
}

TEST(Structs, HaveTheDefaultsOfTheSchema) {
  EXPECT_EQ(difference(to_message(MasterConfig{}), to_message(to_struct(proto::MasterConfig{}))), "");
  EXPECT_EQ(difference(to_message(SlaveConfig{}), to_message(to_struct(proto::SlaveConfig{}))), "");
  EXPECT_EQ(difference(to_message(ImpairmentConfig{}), to_message(to_struct(proto::Impairment{}))), "");
  // What stands in lists has defaults too.
  proto::SlaveConfig config;
  config.mutable_scene()->add_material();
  proto::Surface& surface = *config.mutable_scene()->add_surface();
  surface.mutable_plane();
  surface.mutable_sphere();
  surface.mutable_box();
  surface.mutable_cylinder();
  surface.mutable_hinge();
  surface.mutable_movement();
  config.mutable_scene()->mutable_path();
  for (int i = 0; i < 6; ++i) config.mutable_robot()->add_joint();
  SlaveConfig plain;
  plain.scene.material.resize(1);
  plain.scene.surface = {{"", "", PlaneConfig{}, SphereConfig{}, BoxConfig{}, CylinderConfig{}, HingeConfig{},
                          "", MovementConfig{}}};
  plain.scene.path.emplace();
  EXPECT_EQ(difference(to_message(plain), to_message(to_struct(config))), "");
}

TEST(Structs, HaveDefaultDirectionsAndPointsWhereNoneIsGiven) {
  proto::SlaveConfig config;
  config.mutable_scene()->add_surface()->mutable_plane();
  EXPECT_EQ(to_struct(proto::MasterConfig{}).operator_.direction, OperatorConfig{}.direction);
  EXPECT_EQ(to_struct(config).scene.surface[0].plane.value().point_m, PlaneConfig{}.point_m);
  EXPECT_EQ(to_struct(config).scene.surface[0].plane.value().normal, PlaneConfig{}.normal);
}

TEST(Structs, KeepExtremeNumbersExactly) {
  proto::Impairment impairment;
  for (const double value : {0.0, -0.0, 5e-324, 1e-9, 1e9, 1.7976931348623157e308}) {
    impairment.set_delay_s(value);
    EXPECT_EQ(to_message(to_struct(impairment)).SerializeAsString(),
              to_message(ImpairmentConfig{.delay_s = value}).SerializeAsString());
  }
}

}  // namespace
}  // namespace longreach::structs_test
