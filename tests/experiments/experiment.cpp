#include "tests/experiments/experiment.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <nlohmann/json.hpp>

#include "commit.hpp"
#include "common/config/config.hpp"

namespace longreach {

namespace {

const std::vector<Experiment> kExperiments = {
    {"touch", "Approach, touch, press and probe a wall across the link; is the stiffness in the hand right?",
     run_touch, touch_plots},
    {"first-touch", "A wall met at 50 mm/s, 3 s away: what the hand feels then and at the second touch.",
     run_first_touch, first_touch_plots},
    {"spike", "In contact the delay steps from 0.8 to 12 s: force, energy, and the way back to work.",
     run_spike, spike_plots},
    {"rate-contact", "Pressing on a wall in rate mode: the force at the hand against that of the slave.",
     run_rate_contact, rate_contact_plots},
    {"six-dof-contact", "An oblique plane, a corner and a torque, from stiffness tensors alone.",
     run_six_dof_contact, six_dof_contact_plots},
    {"hostile-updates", "A million hostile stiffness reports in four hands: passive, limited, without steps?",
     run_hostile_updates, hostile_updates_plots},
    {"home-rotation", "The rotational handle returns home on a spring (Fig. 9, 10): damping and stiffness.",
     run_home_rotation, home_rotation_plots},
    {"home-translation", "The translational handle returns home (Fig. 17): on a spring, and gliding.",
     run_home_translation, home_translation_plots},
    {"wall-rotation", "Turning into a virtual wall (Fig. 12).", run_wall_rotation, wall_rotation_plots},
    {"wall-translation",
     "The stiffest stable virtual wall (Fig. 18) against sample time, hand, delay, encoders and friction.",
     run_wall_translation, wall_translation_plots},
    {"gravity", "Torques that carry the translational device, and where it goes when let go (Fig. 15, 16).",
     run_gravity, gravity_plots},
    {"rate-mapping", "Rate control (Fig. 13, 14): deflection and speed of the robot, both laws, dead zone.",
     run_rate_mapping, rate_mapping_plots},
    {"scale-steps", "The buttons step the scale in motion: do goal and force step, is friction f / k_scale?",
     run_scale_steps, scale_steps_plots},
    {"fk-network", "Forward kinematics of the 3-RRR device: error against cost of every way to solve it.",
     run_fk_network, fk_network_plots},
    {"identify",
     "Five estimators of a contact's k, λ and n against the Cramér-Rao bound and a batch fit, from sponge "
     "to steel",
     run_identify, identify_plots},
    {"synthesis",
     "Dimensions of a DELTA by GA, by SQP and by GA then SQP: which search is best, which design?",
     run_synthesis, synthesis_plots},
    {"delay-sweep",
     "Which stiffness reaches the hand across which delay: this law and five textbook laws, and their "
     "limits.",
     run_delay_sweep, delay_sweep_plots},
    {"press-wall",
     "One wall across one link: each textbook law over time, or the one that rendering.law names.",
     run_press_wall, press_wall_plots},
    {"delay-seeds", "The worst of many seeds, over every round trip and every named link that has no outage.",
     run_delay_seeds, delay_seeds_plots},
    {"singular-paths",
     "The tool straight through the wrist, elbow and shoulder singularities of a PUMA 560: its error, the "
     "joints' "
     "speeds.",
     run_singular_paths, singular_paths_plots},
    {"impact", "A mass hits a contact of any stiffness: restitution, energy and cost of four integrators.",
     run_impact, impact_plots},
    {"material-steps", "Slide from soft to hard, press through layers: how soon is the new material known?",
     run_material_steps, material_steps_plots},
    {"docking",
     "A free-floating spacecraft is grasped, dragged and docked across the link (Fig. 20, 21); three "
     "mistakes.",
     run_docking, docking_plots},
    {"scenes-cost", "Microseconds a step of each scene, and with 1 to 10,000 surfaces.", run_scenes_cost,
     scenes_cost_plots},
};

}  // namespace

const std::vector<Experiment>& experiments() { return kExperiments; }

const Experiment* find_experiment(std::string_view name) {
  for (const Experiment& e : experiments()) {
    if (e.name == name) return &e;
  }
  return nullptr;
}

proto::LabConfig configure(const std::vector<std::string>& settings,
                           const std::filesystem::path& deploy_folder) {
  const auto names_file = [](std::string_view setting) {
    const std::string_view path = setting.substr(0, setting.find('='));
    return path == "profile" || path.ends_with("device_file") || path.ends_with("robot_file") ||
           path.ends_with("scene_file");
  };
  proto::LabConfig config;
  for (const std::string& setting : settings) {
    if (names_file(setting)) set_lab_field(config, setting);
  }
  const proto::LinkProfile profile = load_link_profile(deploy_folder, config.profile());
  *config.mutable_slave()->mutable_link()->mutable_impairment() = profile.up();
  *config.mutable_master()->mutable_link()->mutable_impairment() = profile.down();
  config.mutable_master()->mutable_safety()->set_engage_at_start(true);
  resolve_files(*config.mutable_master(), deploy_folder);
  resolve_files(*config.mutable_slave(), deploy_folder);
  for (const std::string& setting : settings) {
    if (!names_file(setting)) set_lab_field(config, setting);
  }
  resolve_files(*config.mutable_slave(), deploy_folder);  // once more for what the settings changed
  validate(config);
  return config;
}

std::string config_hash(const proto::LabConfig& config) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    config.SerializeToCodedStream(&coded);
  }
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = kDigits[(hash >> (4 * i)) & 15];
  return text;
}

std::string_view commit() { return kCommit; }

std::string metrics_json(std::string_view experiment, const ExperimentRun& run,
                         const std::vector<Metric>& metrics) {
  nlohmann::ordered_json json;
  json["experiment"] = experiment;
  json["commit"] = commit();
  json["seed"] = run.seed;
  json["config_hash"] = config_hash(run.config);
  json["metrics"] = nlohmann::ordered_json::object();
  for (const Metric& m : metrics) json["metrics"][m.name] = {{"value", m.value}, {"unit", m.unit}};
  return json.dump(2) + "\n";
}

}  // namespace longreach
