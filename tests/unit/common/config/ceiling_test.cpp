// What clients may change, field by field. The lists here are written by hand, from what the guards read:
// they are the oracle of the options in the schema.
#include "common/config/ceiling.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "common/config/config.hpp"

namespace longreach::ceiling_test {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Paths = std::set<std::string>;

/// Calls `visit(path, field)` for every field that holds no messages and is not read at start.
template <class Visit>
void for_each_changeable(const Descriptor& type, const std::string& prefix, const Visit& visit) {
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    if (field->options().GetExtension(proto::change) == proto::AT_START) continue;
    const std::string path = prefix + field->name();
    if (holds_messages(*field))
      for_each_changeable(*field->message_type(), path + ".", visit);
    else
      visit(path, *field);
  }
}

template <class Config>
Paths free_fields() {
  Paths paths;
  for_each_changeable(*Config::descriptor(), "", [&](const std::string& path, const FieldDescriptor& field) {
    if (field.options().GetExtension(proto::remote) == proto::FREELY) paths.insert(path);
  });
  return paths;
}

/// A value on either side of the start's, from the point of view of who wants to be held safe.
struct Limit {
  std::string path, start, tighter, looser;
};

/// A field that weakens a guard one way or the other: both are refused.
struct Fixed {
  std::string path, start, one, other;
};

const std::vector<Limit>& slave_limits() {
  static const std::vector<Limit> kLimits = {{"command.speed_max_m_per_s", "0.25", "0.1", "0.26"},
                                             {"command.speed_max_rad_per_s", "0.3", "0.1", "0.31"},
                                             {"command.force_guard_n", "20", "10", "20.1"},
                                             {"command.moment_guard_nm", "5", "2", "5.1"},
                                             {"command.give_way_m", "0.2", "0.1", "0.21"},
                                             {"safety.gap_s", "0.2", "0.1", "0.21"},
                                             {"safety.age_max_s", "30", "10", "31"},
                                             {"safety.resume_s", "1", "0", "1.1"},
                                             {"safety.delay_rise_max_s", "1", "0.1", "1.1"},
                                             {"playout.fixed_delay_s", "0.02", "0.01", "0.5"},
                                             {"playout.delay_max_s", "0.5", "0.1", "5"},
                                             {"link.heartbeat_contact_hz", "4", "10", "1"},
                                             {"link.heartbeat_free_hz", "2", "10", "1"}};
  return kLimits;
}

const std::vector<Fixed>& slave_fixed() {
  static const std::vector<Fixed> kFixed = {
      // Slower brakes later; faster stresses arm and contact.
      {"command.acceleration_max_m_per_s2", "1.25", "0.01", "2"},
      {"command.acceleration_max_rad_per_s2", "2", "0.01", "3"},
      // Softer brakes late at a touch; stiffer believes a sensor that leaps, and bleeds off slowly.
      {"command.guard_stiffness_n_per_m", "2e4", "1e3", "1e6"},
      {"command.braking_max_m_per_s2", "10", "0.1", "20"},
      // A smaller one draws the robot in.
      {"command.workspace_m", "3", "0.1", "4"},
      {"command.hold_force_n", "5", "1", "10"},
      {"command.tolerance_m", "1e-10", "1e-12", "1e-3"},
      {"command.iterations_max", "20", "1", "1000"},
      {"sensing.force_noise_n", "0.05", "0", "10"},
      {"sensing.moment_noise_nm", "0.005", "0", "1"},
      {"sensing.touch_n", "0.3", "0.2", "0"},
      {"sensing.release_n", "0.12", "0.01", "0.2"},
      {"sensing.touch_nm", "0.03", "0.02", "90"},
      {"sensing.release_nm", "0.012", "0.001", "0.02"},
      {"sensing.filter_s", "0.01", "0", "1"},
      {"sensing.force_bias_n", "0", "-9", "9"},
      {"sensing.moment_bias_nm", "0", "-1", "1"},
      {"sensing.force_drift_n", "0.1", "0", "9"},
      {"sensing.moment_drift_nm", "0.1", "0", "1"},
      {"sensing.force_resolution_n", "0.1", "0", "100"},
      {"sensing.moment_resolution_nm", "0.1", "0", "100"},
      {"sensing.force_range_n", "100", "0", "1000"},
      {"sensing.moment_range_nm", "10", "0", "100"},
      {"sensing.bandwidth_hz", "500", "0.1", "0"},
      {"sensing.tool.mass_kg", "1", "0", "5"},
      {"sensing.tool.com_m", "0,0,0.1", "0,0,0", "1,0,0"},
      {"sensing.tool.inertia_kg_m2", "1,1,1", "0,0,0", "9,9,9"},
      {"sensing.gravity_m_per_s2", "0,0,-9.81", "0,0,0", "0,0,9.81"},
      {"sensing.zero_s", "0.5", "0", "100"}};
  return kFixed;
}

const std::vector<Limit>& master_limits() {
  static const std::vector<Limit> kLimits = {
      {"rendering.force_max_n", "15", "5", "100"},
      {"rendering.moment_max_nm", "0.3", "0.1", "10"},
      {"rendering.slew_n_per_s", "5000", "100", "1e6"},
      {"rendering.slew_nm_per_s", "200", "10", "1e5"},
      {"rendering.ke", "1", "0.5", "1.1"},
      {"rendering.ke_rotation", "1", "0.5", "1.1"},
      {"rendering.stiffness_max_n_per_m", "7000", "1000", "1e5"},
      {"rendering.stiffness_max_nm_per_rad", "10", "1", "1000"},
      {"rendering.fade_s", "0.2", "0.1", "5"},
      {"rendering.tank_max_j", "0.02", "0", "1"},
      {"rendering.store_j", "0.02", "0", "0.1"},
      {"rendering.ramp_s", "0.05", "0.02", "1"},
      {"rendering.rate_stiffness_n_per_m", "60", "10", "1000"},
      {"rendering.rotational_stiffness_nm_per_rad", "0.4", "0.1", "10"},
      {"rendering.friction_n", "0.1", "0", "5"},
      {"rendering.friction_nm", "0.003", "0", "1"},
      {"rendering.friction_stiffness_n_per_m", "1000", "100", "5000"},
      {"rendering.friction_stiffness_nm_per_rad", "1", "0.1", "10"},
      {"rendering.load_factor", "1.5", "1", "10"},
      {"rendering.rate_force_ratio", "0.1", "0.05", "0.2"},
      {"device.behaviour.home_n_per_m", "100", "10", "1000"},
      {"device.behaviour.home_nm_per_rad", "0.4", "0.1", "10"},
      {"device.behaviour.home_speed_m_per_s", "0.05", "0.01", "1000"},
      {"device.behaviour.home_speed_rad_per_s", "1", "0.1", "1e4"},
      {"device.behaviour.guide_n_per_m", "500", "100", "5000"},
      {"device.behaviour.guide_nm_per_rad", "0.4", "0.1", "10"},
      {"mapping.speed_max_m_per_s", "0.25", "0.1", "10"},
      {"mapping.speed_max_rad_per_s", "0.3", "0.1", "10"},
      {"mapping.dead_zone_m", "0.005", "0.01", "0"},
      {"mapping.dead_zone_rad", "0.05", "0.1", "0"},
      {"mapping.radius_max_m", "0.05", "0.02", "1"},
      {"mapping.radius_max_rad", "0.5", "0.2", "3"},
      {"safety.silence_s", "0.5", "0.2", "10"},
      {"safety.resume_s", "1", "0", "10"},
      {"safety.presence", "HOLD", "HOLD", "IGNORE"},
      {"safety.presence_s", "0.3", "0.1", "10"},
      {"safety.gap_s", "0.1", "0.05", "0.11"},
      {"safety.delay_rise_max_s", "1", "0.1", "1.1"}};
  return kLimits;
}

const std::vector<Fixed>& master_fixed() {
  static const std::vector<Fixed> kFixed = {
      {"rendering.law", "STIFFNESS", "NAIVE", "WAVE"},
      {"rendering.contact_damping_n_s_per_m", "3", "0", "50"},
      {"rendering.contact_damping_nm_s_per_rad", "1e-3", "0", "1"},
      {"rendering.rate_damping_n_s_per_m", "4", "0", "50"},
      {"rendering.rotational_damping_nm_s_per_rad", "0.01", "0", "1"},
      {"rendering.registration", "TOUCH", "ARRIVAL", "ARRIVAL"},
      {"rendering.home_spring", "false", "true", "true"},
      {"rendering.ke_by_scale", "true", "false", "false"},
      {"device.behaviour.home_n_s_per_m", "4", "0", "50"},
      {"device.behaviour.home_nm_s_per_rad", "0.01", "0", "1"},
      {"device.behaviour.free_m", "0.003", "1e-4", "1"},
      {"device.behaviour.free_rad", "0.03", "1e-3", "3"},
      {"device.behaviour.stop_share", "0.93", "0.1", "1"},
      {"device.behaviour.stop_n_per_m", "1500", "0", "5000"},
      {"device.behaviour.stop_nm_per_rad", "1", "0", "10"},
      {"mapping.rate_law", "CONTINUOUS", "LITERAL", "LITERAL"},
      {"mapping.rate_centre", "HANDLE_ORIGIN", "WHERE_MODE_BEGAN", "WHERE_MODE_BEGAN"},
      {"mapping.base_rotation_rad", "0,0,0", "0,0,3.1", "0,3,0"},
      {"safety.engage_at_start", "false", "true", "true"}};
  return kFixed;
}

template <class Config>
Config with(Config config, const std::string& path, const std::string& value) {
  set_field(config, path, value);
  return config;
}

template <class Config>
void expect_held(const std::vector<Limit>& limits, const std::vector<Fixed>& fixed) {
  for (const auto& [path, at, tighter, looser] : limits) {
    const Config start = with(Config{}, path, at);
    EXPECT_EQ(beyond_ceiling(start, start), std::nullopt) << path;
    EXPECT_EQ(beyond_ceiling(start, with(start, path, tighter)), std::nullopt) << path;
    EXPECT_TRUE(beyond_ceiling(start, with(start, path, looser)).value_or("").starts_with(path + " = "))
        << path;
  }
  for (const auto& [path, at, one, other] : fixed) {
    const Config start = with(Config{}, path, at);
    for (const std::string& value : {one, other})
      EXPECT_TRUE(beyond_ceiling(start, with(start, path, value))
                      .value_or("")
                      .starts_with(path + " cannot be "
                                          "changed"))
          << path << " = " << value;
  }
}

TEST(Ceiling, HoldsEveryFieldThatCanWeakenAGuardOfTheSlave) {
  expect_held<proto::SlaveConfig>(slave_limits(), slave_fixed());
}

TEST(Ceiling, HoldsEveryFieldThatCanWeakenAGuardOfTheMaster) {
  expect_held<proto::MasterConfig>(master_limits(), master_fixed());
}

template <class Config>
void expect_decided(const std::vector<Limit>& limits, const std::vector<Fixed>& fixed) {
  Paths decided = free_fields<Config>();
  for (const Limit& limit : limits) decided.insert(limit.path);
  for (const Fixed& field : fixed) decided.insert(field.path);
  int fields = 0;
  for_each_changeable(*Config::descriptor(), "", [&](const std::string& path, const FieldDescriptor& field) {
    ++fields;
    EXPECT_TRUE(field.options().HasExtension(proto::remote)) << path << ": say what clients may do with it";
    EXPECT_TRUE(decided.contains(path) || path == "device.name" || path == "device.basis")
        << path << ": list here what loosens it";
  });
  EXPECT_GT(fields, 40);
}

TEST(Ceiling, EveryFieldThatMayChangeSaysWhatClientsMayDoWithIt) {
  expect_decided<proto::SlaveConfig>(slave_limits(), slave_fixed());
  expect_decided<proto::MasterConfig>(master_limits(), master_fixed());
}

const char* const kImpairment[] = {
    "delay_s",           "jitter_s",        "loss",           "loss_burst",       "duplicate",
    "reorder",           "corrupt",         "rate_bit_per_s", "queue_s",          "step_delay_s",
    "step_start_s",      "step_duration_s", "drift_s_per_s",  "blackout_start_s", "blackout_duration_s",
    "blackout_period_s", "rpc_delay_s"};

// The network, what the hand is told (its own guards stand whatever that is), who stands for a person, and
// what is for the eyes.
TEST(Ceiling, LeavesNothingElseToClientsThanThis) {
  Paths slave = {"link.telemetry_hz",    "link.budget_kbit_per_s",   "playout.adaptive",
                 "playout.quantile",     "estimator.kind",           "estimator.exponent",
                 "estimator.forgetting", "estimator.depth_memory_s", "estimator.first_sd",
                 "estimator.deadband"};
  Paths master = {"device.behaviour.idle",
                  "device.behaviour.motion",
                  "hand.grip",
                  "mapping.mode",
                  "mapping.scale",
                  "mapping.kv_per_s",
                  "mapping.kv_rotation_per_s",
                  "mapping.goal_follows_force",
                  "mapping.simultaneous"};
  for (const char* field : {"rate_distance_m", "approach_speed_m_per_s", "press_n", "probe_n", "probe_hz",
                            "probe_cycles", "direction", "reaction_s"})
    master.insert("operator." + std::string(field));
  for (const char* field : kImpairment) {
    slave.insert("link.impairment." + std::string(field));
    master.insert("link.impairment." + std::string(field));
  }
  EXPECT_EQ(free_fields<proto::SlaveConfig>(), slave);
  EXPECT_EQ(free_fields<proto::MasterConfig>(), master);
}

TEST(Ceiling, WhatIsLeftToClientsGoesEitherWay) {
  const proto::MasterConfig start;
  for (const auto& [path, one, other] :
       {std::array{"operator.direction", "0,1,0", "1,0,0"}, std::array{"mapping.scale", "0.1", "1"},
        std::array{"mapping.mode", "RATE", "POSITION"}, std::array{"link.impairment.delay_s", "0", "5"}}) {
    EXPECT_EQ(beyond_ceiling(start, with(start, path, one)), std::nullopt) << path;
    EXPECT_EQ(beyond_ceiling(with(start, path, one), with(start, path, other)), std::nullopt) << path;
  }
}

TEST(Ceiling, LimitsAreNumbersInOrder) {
  for (const Descriptor* side : {proto::SlaveConfig::descriptor(), proto::MasterConfig::descriptor()}) {
    for_each_changeable(*side, "", [&](const std::string& path, const FieldDescriptor& field) {
      const proto::Remote remote = field.options().GetExtension(proto::remote);
      const bool limit = remote == proto::TIGHTER_DOWN || remote == proto::TIGHTER_UP;
      const auto type = field.cpp_type();
      const bool ordered = !field.is_repeated() &&
                           (type == FieldDescriptor::CPPTYPE_DOUBLE || type == FieldDescriptor::CPPTYPE_ENUM);
      EXPECT_TRUE(!limit || ordered) << path;
      EXPECT_TRUE(remote == proto::TIGHTER_DOWN || !field.options().HasExtension(proto::automatic)) << path;
    });
  }
}

TEST(Ceiling, ShorterValuesReduceGapTimerDerivedFromSendRate) {
  const proto::SlaveConfig start;
  EXPECT_EQ(beyond_ceiling(start, with(start, "safety.gap_s", "0.1")), std::nullopt);
  EXPECT_NE(beyond_ceiling(start, with(start, "safety.gap_s", "0.101")), std::nullopt);
  const auto explicit_start = with(start, "safety.gap_s", "0.1");
  EXPECT_NE(beyond_ceiling(explicit_start, start), std::nullopt);
}

TEST(Ceiling, LimitsGoBackUpToTheStartAndNoFurther) {
  const auto start = with(proto::SlaveConfig{}, "command.force_guard_n", "15");
  const auto tight = with(start, "command.force_guard_n", "8");
  EXPECT_EQ(beyond_ceiling(start, with(tight, "command.force_guard_n", "15")), std::nullopt);
  EXPECT_NE(beyond_ceiling(start, with(tight, "command.force_guard_n", "15.000000000000002")), std::nullopt);
}

TEST(Ceiling, SaysWhichFieldAtWhichCeilingAndWhatToDo) {
  const proto::SlaveConfig start;
  EXPECT_EQ(beyond_ceiling(start, with(start, "command.force_guard_n", "40")),
            "command.force_guard_n = 40 is less restrictive than 20, the limit with which this side "
            "was started, and a client can only tighten this limit; change it in the configuration "
            "file of this side and restart this side");
  EXPECT_EQ(beyond_ceiling(start, with(start, "sensing.zero_s", "100")),
            "sensing.zero_s cannot be changed by a client: it is 0; change it in the configuration "
            "file of this side and restart this side");
  EXPECT_EQ(beyond_ceiling(start, with(start, "sensing.gravity_m_per_s2", "0,0,-9.81")),
            "sensing.gravity_m_per_s2 cannot be changed by a client: it is not set; change it in the "
            "configuration file of this side and restart this side");
  proto::SlaveConfig more = start;
  more.mutable_scene()->add_material();
  EXPECT_EQ(beyond_ceiling(start, more),
            "scene.material cannot be changed by a client; change it in the configuration file of "
            "this side and restart this side");
  EXPECT_EQ(beyond_ceiling(start, with(start, "robot_file", "robots/other.txtpb")),
            "robot_file cannot be changed by a client: it is robots/space_arm.txtpb; change it in the "
            "configuration file of this side and restart this side");
}

TEST(Ceiling, IsShownBesideTheValue) {
  const auto start = with(proto::MasterConfig{}, "safety.silence_s", "0.7");
  const auto now = with(start, "safety.silence_s", "0.3");
  EXPECT_EQ(get_field(now, "safety", &start),
            "silence_s: 0.3  # may be set: 0.7 or less\nresume_s: 1  # may be set: 1 or less\n"
            "engage_at_start: false\npresence: IGNORE  # may be set: IGNORE or more\n"
            "presence_s: 0.3  # may be set: 0.3 or less\ngap_s: 0.1  # may be set: 0.1 or less\n"
            "delay_rise_max_s: 1  # may be set: 1 or less\n");
  EXPECT_EQ(get_field(now, "safety.silence_s", &start), "0.3");
  proto::MasterConfig again;
  load_text("again", get_field(now, "", &start), again);
  EXPECT_EQ(get_field(again, ""), get_field(now, ""));
  EXPECT_NE(get_field(now, "").find("silence_s: 0.3\n"), std::string::npos) << "without a start no note";
}

}  // namespace
}  // namespace longreach::ceiling_test
