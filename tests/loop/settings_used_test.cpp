// No setting without effect: what an experiment declares in Experiment::uses is what its runs go by, and
// anything else is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "common/config/config.hpp"
#include "common/config/field_path.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/delay/delay_grid.hpp"
#include "deploy/lab/laboratory.hpp"
#include "deploy/lab/settings_used.hpp"

namespace longreach::settings_used_test {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// What the first laboratory of an experiment runs with.
struct Begun : std::exception {
  std::string configs;
  bool driven = false;
};

/// Experiments whose laboratories come late, or that have none: by their used groups, settings that change
/// their metrics.
const std::map<std::string, std::map<std::string, std::string>> kWithoutLaboratory = {
    {"tensor-rendering",
     {{"device", "device.delta.workspace_m=0.05"},
      {"mapping", "mapping.base_rotation_rad=0,0,0.3"},
      {"rendering", "rendering.ke=0.5"}}},
    {"hostile-updates",
     {{"device", "device.delta.drive.torque_max_nm=0.1"},
      {"mapping", "mapping.scale=0.3"},
      {"rendering", "rendering.ke=0.5"}}},
    {"idle", {{"mapping", "mapping.dead_zone_m=0.004"}, {"rendering", "rendering.ke=0.5"}}},
    {"home-rotation", {{"device", "device.spherical.drive.coulomb_nm=0.01"}}},
    {"home-translation", {{"device", "device.delta.drive.coulomb_nm=0.01"}}},
    {"wall-rotation", {{"device", "device.spherical.drive.coulomb_nm=0.01"}}},
    {"wall-translation", {{"device", "device.delta.drive.viscous_nm_s_per_rad=0.01"}}},
    {"gravity", {{"device", "device.delta.drive.coulomb_nm=0.01"}}},
    {"press-wall",
     {{"device", "device.delta.drive.viscous_nm_s_per_rad=0.01"},
      {"hand", "hand.grip=FIRM"},
      {"rendering.law", "rendering.law=WAVE"},
      {"link.impairment.delay_s", "slave.link.impairment.delay_s=0.3"},
      {"link.impairment.jitter_s", "slave.link.impairment.jitter_s=0.03"},
      {"link.impairment.loss", "slave.link.impairment.loss=0.1"},
      {"scene.material.stiffness_n_per_m", "scene.material.wall.stiffness_n_per_m=300"}}},
};
/// Many seconds a run: only at full size.
const std::set<std::string> kLong = {"hostile-updates", "idle"};
/// Minutes each: one of its stages takes the device (trade_sample_rate).
const std::set<std::string> kTooLong = {"trade"};

/// Another value of a field, within its range; empty for what has none.
std::string other_value(const Message& at, const FieldDescriptor& field, double sign) {
  const auto* reflection = at.GetReflection();
  if (field.is_repeated()) return "";
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection->GetBool(at, &field) ? "false" : "true";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* value = reflection->GetEnum(at, &field);
      return std::string(value->type()->value((value->index() + 1) % value->type()->value_count())->name());
    }
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(reflection->GetUInt32(at, &field) + (sign > 0.0 ? 1 : -1));
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      const double value = reflection->GetDouble(at, &field);
      return format_number(value + sign * 1e-3 * (value == 0.0 ? 1.0 : value));
    }
    default:
      return "";
  }
}

/// Calls `visit` with every field that holds one value, the first element of every list in it, and another
/// value for it that the schema takes.
template <class Visit>
void visit_fields(const proto::LabConfig& root, const Message& at, FieldPath& path, const Visit& visit) {
  for (int i = 0; i < at.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *at.GetDescriptor()->field(i);
    if (field.is_repeated() && at.GetReflection()->FieldSize(at, &field) == 0) continue;
    path.push_back({&field, field.is_repeated() ? 0 : -1});
    if (holds_messages(field)) {
      if (field.is_repeated() || at.GetReflection()->HasField(at, &field))
        visit_fields(root, message_at(at, path.back()), path, visit);
    } else {
      for (const double sign : {1.0, -1.0}) {
        proto::LabConfig changed = root;
        const std::string value = other_value(at, field, sign), text = path_text(root, path);
        if (value.empty()) break;
        try {
          set_field(changed, text, value);
        } catch (const ConfigError&) {
          continue;  // at the end of its range
        }
        visit(text, changed);
        break;
      }
    }
    path.pop_back();
  }
}

/// Every field is in it.
proto::LabConfig whole_config() {
  proto::LabConfig config = configure({}, LONGREACH_DEPLOY);
  *config.mutable_master() = to_message(to_struct(config.master()));
  *config.mutable_slave() = to_message(to_struct(config.slave()));
  return config;
}

/// Up to the first step of its first laboratory. A run that is refused is another one, too.
Begun begin(const Experiment& experiment, const proto::LabConfig& config) {
  ExperimentRun run;
  run.config = config;
  try {
    if (experiment.name == "delay-sweep")
      touch_across(run, plain_link(config, 0.5), 1000.0, Grip::kLight);
    else
      experiment.run(run);
  } catch (const Begun& begun) {
    return begun;
  } catch (const std::exception& e) {
    Begun refused;
    refused.configs = e.what();
    return refused;
  }
  ADD_FAILURE() << experiment.name << " has no laboratory";
  return {};
}

class SettingsUsed : public testing::Test {
 protected:
  void SetUp() override { Laboratory::of_all = &hooks_; }
  void TearDown() override { Laboratory::of_all = nullptr; }

 private:
  struct Begins : FaultHooks {
    void begins(const MasterConfig& master, const SlaveConfig& slave, bool driven) override {
      Begun begun;
      begun.configs = to_message(master).SerializeAsString() + to_message(slave).SerializeAsString();
      begun.driven = driven;
      throw begun;
    }
  };
  Begins hooks_;
};

TEST_F(SettingsUsed, EveryUsedFieldReachesTheRuns) {
  const proto::LabConfig config = whole_config();
  int first = 0;
  for (const Experiment& experiment : experiments()) {
    const std::string name(experiment.name);
    ++first;
    if (experiment.uses.empty() || kWithoutLaboratory.contains(name) || kTooLong.contains(name)) continue;
    const Begun usual = begin(experiment, config);
    FieldPath path;
    int used = 0;
    visit_fields(config, config, path, [&](const std::string& field, const proto::LabConfig& changed) {
      if (!uses_setting(experiment, field) || field.find('.') == std::string::npos) return;
      // Every third field, another third in each experiment; all at full size.
      if ((used++ + first) % campaign(1, 3) != 0) return;
      EXPECT_TRUE(begin(experiment, changed).configs != usual.configs)
          << name << " sets " << field << " itself, so it does not use it";
      EXPECT_FALSE(usual.driven && field.starts_with("master.operator"))
          << name << " does not ask the script";
    });
    EXPECT_GT(used, 50) << name;
  }
}

TEST_F(SettingsUsed, EveryUsedGroupOfTheOthersChangesTheirMetrics) {
  Laboratory::of_all = nullptr;
  const auto metrics = [](const Experiment& experiment, const std::vector<std::string>& settings) {
    ExperimentRun run;
    run.config = configure(settings, LONGREACH_DEPLOY);
    std::string text;
    for (const Metric& m : experiment.run(run))
      if (!m.of_machine) text += m.name + " " + format_number(m.value) + "\n";
    return text;
  };
  for (const auto& [name, of_group] : kWithoutLaboratory) {
    if (kLong.contains(name) && campaign(1, 0) == 0) continue;
    const Experiment& experiment = *find_experiment(name);
    std::istringstream words{std::string(experiment.uses)};
    std::set<std::string> groups;
    for (std::string word; words >> word;)
      if (word.front() != '-') groups.insert(word);
    EXPECT_EQ(groups.size(), of_group.size()) << name;
    const std::string usual = metrics(experiment, {});
    for (const auto& [group, setting] : of_group) {
      EXPECT_TRUE(groups.contains(group)) << name << " " << group;
      EXPECT_TRUE(uses_setting(experiment, setting.substr(0, setting.find('=')))) << name << " " << setting;
      EXPECT_TRUE(metrics(experiment, {setting}) != usual) << name << " does not use " << setting;
    }
  }
}

TEST_F(SettingsUsed, WhatAnExperimentSetsItselfIsRefused) {
  const auto refused = [](const char* experiment, const char* setting) -> std::string {
    try {
      refuse_unused(*find_experiment(experiment), {setting});
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  for (const auto& [experiment, setting] : std::vector<std::pair<const char*, const char*>>{
           {"first-touch", "profile=rt500"},
           {"first-touch", "master.link.impairment.delay_s=1"},
           {"delay-seeds", "scene.material.wall.stiffness_n_per_m=300"},
           {"rate-contact", "operator.press_n=2"},
           {"docking", "scene_file=scenes/wall.txtpb"},
           {"gravity", "accuracy=FAST"},
           {"touch", "slave.rpc.listen=127.0.0.1:1"},
           {"spike", "duration_s=30"},
           {"scenes-cost", "profile=lab"},
           {"moving-wall", "command.force_guard_n=10"}})
    EXPECT_TRUE(refused(experiment, setting).starts_with(std::string(experiment) + " does not use "))
        << experiment << " " << setting;
  for (const auto& [experiment, setting] :
       std::vector<std::pair<const char*, const char*>>{{"touch", "profile=lab"},
                                                        {"touch", "scene_file=scenes/hinge.txtpb"},
                                                        {"delay-seeds", "scene.material.wall.exponent=1.5"},
                                                        {"first-touch", "command.force_guard_n=10"},
                                                        {"gravity", "device_file=devices/paper.txtpb"},
                                                        {"rate-contact", "accuracy=FAST"}})
    EXPECT_EQ(refused(experiment, setting), "") << experiment << " " << setting;
}

}  // namespace
}  // namespace longreach::settings_used_test
