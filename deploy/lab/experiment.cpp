#include "deploy/lab/experiment.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/config/config.hpp"
#include "common/recording/build_name.hpp"
#include "deploy/lab/name_hash.hpp"

namespace longreach {

namespace {

const std::vector<Experiment> kExperiments = {
    {"touch", "Approach, touch, press and probe a wall across the link: is the displayed stiffness correct?",
     "master slave duration_s trace_hz", run_touch, touch_plots, "",
     "{displayed_stiffness_n_per_m} N/m displayed for a wall of {reference_stiffness_n_per_m} N/m at a "
     "round trip of {rtt_s} s; surface found within {wall_registration_error_m*1e6} µm"},
    {"first-touch",
     "First touch of a wall at 50 mm/s and a round trip of 3 s: the force on the hand at the first and "
     "second touch.",
     "master slave -link.impairment -operator -hand -mapping.mode -mapping.scale -rendering.registration "
     "-scene.material.stiffness_n_per_m -scene.surface",
     run_first_touch, first_touch_plots, "",
     "force on the hand {felt_after_round_trip_s} s after the round trip of {round_trip_s} s, largest "
     "step {force_step_max_n} N, wall registered within {registration_error_m*1e6} µm, without the touch"
     " sequence {registration_error_without_touch_sequence_m*1e3} mm; force at the tool at most "
     "{guard_peak_over_guard_max} times the guard, {guard_peak_over_guard_max_without_guard} times without "
     "the guard"},
    {"spike", "The delay steps from 0.8 to 12 s in contact: force, energy, and recovery.",
     "master slave -link.impairment -operator.rate_distance_m -operator.probe_cycles -scene.surface.plane",
     run_spike, spike_plots, "",
     "{stiffness_left_after_time_constant*100} % of the stiffness remains after one time constant; the force "
     "rises by at most {force_rise_max_n} N; {engagements} engagements, pressed again: {pressed_again}"},
    {"person",
     "Operators hold out, lean on limits, miss the surface, clutch and stop in contact; five links, two "
     "hands.",
     "master slave -link.impairment -operator -hand -mapping.mode -scene", run_person_experiment,
     person_plots, "",
     "{rows} rows, {trials} trials over five links with light and firm hands: {failed} failed; without "
     "the position of the tool in the reports {controls_failed} of {controls}"},
    {"rate-contact", "Pressing on a wall in rate mode: the force at the hand against the force at the slave.",
     "master slave -operator -hand -mapping.mode -scene.surface.plane", run_rate_contact, rate_contact_plots,
     "", "the force on the hand is {felt_over_tool_force} of the force at the tool of {tool_force_n} N"},
    {"six-dof-contact", "An oblique plane, corners and a rotational stop, without a model of the scene.",
     "master slave -operator -hand -mapping.mode -mapping.scale -rendering.friction_n -rendering.friction_nm "
     "-rendering.rotational_stiffness_nm_per_rad -scene",
     run_six_dof_contact, six_dof_contact_plots, "",
     "force error {oblique_force_error*100} % on an oblique plane, {corner_x_force_error*100} and "
     "{corner_y_force_error*100} % in a corner, {diagonal_x_force_error*100} and "
     "{diagonal_y_force_error*100} % in a corner that is pressed diagonally; stiffness error "
     "{oblique_displayed_error*100} %, {corner_x_displayed_error*100} and {corner_y_displayed_error*100}"
     " %, {diagonal_x_displayed_error*100} and {diagonal_y_displayed_error*100} %, in torsion "
     "{torque_displayed_error*100} %"},
    {"tensor-rendering", "The same contacts from given surface reports: the error of the rendering alone.",
     "device mapping rendering -mapping.mode -mapping.scale -rendering.friction_n "
     "-rendering.rotational_stiffness_nm_per_rad",
     run_tensor_rendering, tensor_rendering_plots, "",
     "error {oblique_displayed_error*100} % on an oblique plane, {corner_displayed_error_x*100} and "
     "{corner_displayed_error_y*100} % in a corner, {torque_displayed_error*100} % in torsion"},
    {"hostile-updates",
     "Half a million hostile stiffness reports with four hands: does the rendering stay passive and "
     "limited?",
     "device rendering mapping -device.delay_samples -rendering.law", run_hostile_updates,
     hostile_updates_plots, "",
     "{updates*1e-6} million updates, {unsafe_wrenches} unsafe wrenches; minimum port energy "
     "{port_energy_min_j*1e3} mJ, without the rules {naive_port_energy_min_j} J"},
    {"idle", "A hand at rest: energy, ripple and limit cycles, free, pressed and released.",
     "mapping rendering -mapping.mode -mapping.scale -rendering.home_spring", run_idle, idle_plots, "",
     "{draws} random devices, positions, grips and walls: {bad} bad; at most {energy_out_max_j*1e3} mJ "
     "are returned beyond the store, the ripple of the force exceeds one count by at most "
     "{ripple_beyond_a_count_max_n*1e3} mN; with damping on the encoders' velocity {control_bad} of "
     "{control_draws} bad"},
    {"home-rotation", "The rotational handle returns home on a spring: damping and stiffness.", "device",
     run_home_rotation, home_rotation_plots, "Fig. 9, 10",
     "settling within {settling_difference_max*100} % of the closed form; overshoot {overshoot_at_0.5*100} % "
     "at a damping ratio of {zeta_at_0.5}, none at 1"},
    {"home-translation", "The translational handle returns home: on a spring, and gliding.", "device",
     run_home_translation, home_translation_plots, "Fig. 17",
     "settling within {settling_difference_max*100} % of the closed form; {left_gliding*1e3} mm remain "
     "after gliding home"},
    {"wall-rotation", "Turning into a virtual wall.", "device", run_wall_rotation, wall_rotation_plots,
     "Fig. 11, 12", "at 20 mN m depth {depth_at_20} degrees, expected {depth_expected_at_20}"},
    {"wall-translation",
     "The maximum stable stiffness of a virtual wall against sample time, hand, delay, encoders and "
     "friction.",
     "device", run_wall_translation, wall_translation_plots, "Fig. 18",
     "stability limit within {limit_difference_max*100} % of the sampled model; 5 N/mm at 1 kHz is stable, "
     "limit {paper_wall_limit_light*1e-3}, {paper_wall_limit_firm*1e-3}, {paper_wall_limit_released*1e-3} "
     "N/mm (light, firm, released)"},
    {"gravity", "Gravity compensation of the translational device, and its drift when released.", "device",
     run_gravity, gravity_plots, "Fig. 15, 16",
     "{torque_home_1} mN m at home, {torque_paper_home_1} to {torque_paper_home_3} in the paper; drift "
     "{drift_real_max*1e6} µm, without compensation {drift_without_compensation*1e3} mm"},
    {"rate-mapping", "Rate control: deflection and speed of the robot, both laws, dead zone.",
     "master slave -operator -hand -mapping.mode -mapping.rate_law", run_rate_mapping, rate_mapping_plots,
     "Fig. 13, 14",
     "at the edge of the dead zone the speed steps by {speed_step_translation_continuous*1e3} mm/s, with the "
     "literal law by {speed_step_translation_literal*1e3} mm/s"},
    {"scale-steps",
     "The buttons change the scale during motion: do goal and force step, is the friction f / k_scale?",
     "master slave -operator -mapping.mode", run_scale_steps, scale_steps_plots, "",
     "{scale_steps} changes of the scale: the goal steps by {goal_step_max_m} m, the force by "
     "{force_step_max_n} N; friction within {friction_error_max*100} % of f / k_scale"},
    {"path-task",
     "Simulated operators follow a path to targets: rate, position and hybrid mode, over the delay, with"
     " a ghost.",
     "master slave -link.impairment -operator -mapping.mode -mapping.base_rotation_rad -robot -scene",
     run_path_task, path_task_plots, "Fig. 19, Table 2",
     "{operators} simulated operators at a round trip of 2.6 s: rate {rate_time_s_at_2.6} s and "
     "{rate_error_m_at_2.6*1e3} mm off the path, position {position_time_s_at_2.6} s and "
     "{position_error_m_at_2.6*1e3} mm, hybrid {hybrid_time_s_at_2.6} s and {hybrid_error_m_at_2.6*1e3} "
     "mm; with the ghost {ghost_hybrid_time_s_at_2.6} s; on average hybrid is faster than position at "
     "{hybrid_gains_on_position_delays} and closer to the path than rate at "
     "{hybrid_gains_on_rate_delays} of 4 delays (p < 0.05 at {hybrid_gains_on_position_delays_surely} "
     "and {hybrid_gains_on_rate_delays_surely})"},
    {"mapping-trade",
     "Trade-offs of the mapping: time against error over kv, k_scale, the dead zone and the switching "
     "distance of hybrid mode.",
     "master slave -link.impairment -operator -mapping.kv_per_s -mapping.scale -mapping.dead_zone_m "
     "-mapping.mode -mapping.base_rotation_rad -robot -scene",
     run_mapping_trade, mapping_trade_plots, "",
     "round trip {rtt_s} s: rate {rate_kv_per_s_error_m_at_0.5*1e3} mm off the path at kv 0.5/s, "
     "{rate_kv_per_s_error_m_at_4*1e3} mm at 4/s; position {position_k_scale_time_s_at_0.2} s and "
     "{position_k_scale_error_m_at_0.2*1e3} mm at k_scale 0.2, {position_k_scale_time_s_at_1} s and "
     "{position_k_scale_error_m_at_1*1e3} mm at 1; hybrid {hybrid_near_sd_time_s_at_0} s and "
     "{hybrid_near_sd_error_m_at_0*1e3} mm in rate mode up to the target, {hybrid_near_sd_time_s_at_4} s"
     " and {hybrid_near_sd_error_m_at_4*1e3} mm if rate mode ends 4 sd before"},
    {"fk-network", "Forward kinematics of the 3-RRR device: error against cost of every method.", "",
     run_fk_network, fk_network_plots, "",
     "largest error: tracking {tracking_error_max_rad} rad, network {network_error_max_rad} rad, network"
     " and one Newton step {network_newton_error_max_rad} rad"},
    {"identify",
     "Seven estimators of k, λ and n of a contact against the Cramér-Rao bound and a batch fit, from "
     "sponge to steel",
     "", run_identify, identify_plots, "",
     "worst error of the stiffness while probing: maximum likelihood "
     "{stiffness_error_worst_maximum_likelihood_probe} %, batch fit {stiffness_error_worst_batch_probe} %, "
     "extended Kalman filter {stiffness_error_worst_extended_kalman_probe} %, weighted log-linear "
     "{stiffness_error_worst_weighted_log_linear_probe} %, log-linear "
     "{stiffness_error_worst_log_linear_probe} %, two-stage {stiffness_error_worst_two_stage_probe} %"},
    {"synthesis",
     "Dimensions of a DELTA by GA, by SQP and by GA followed by SQP: which search and which design is "
     "best?",
     "", run_synthesis, synthesis_plots, "",
     "worst conditioning in a 60 mm cube {a_conditioning}; of the reconstructed device "
     "{catalog_conditioning}"},
    {"delay-sweep", "Displayed stiffness over the delay: this law and five textbook laws, and their limits.",
     "master slave -link.impairment.delay_s -hand -rendering.law -scene.material.stiffness_n_per_m",
     run_delay_sweep, delay_sweep_plots, "",
     "{stiffness_within_5_percent} of {stiffness_cases} cases within 5 %; direct force displays at most "
     "{direct_limit_at_3*1e-3} N/mm at 3 s, wave variables {wave_limit_at_3*1e-3} N/mm"},
    {"press-wall",
     "One wall across one link: each textbook law over time, or the law that rendering.law names.",
     "device hand rendering.law link.impairment.delay_s link.impairment.jitter_s link.impairment.loss "
     "scene.material.stiffness_n_per_m",
     run_press_wall, press_wall_plots, "",
     "{wall_n_per_m} N/m at a round trip of {rtt_s} s: direct force returns "
     "{direct_port_energy_min_j*-1} J to the operator; passivity observer {tdpa_displayed_n_per_m} N/m, "
     "position-position {position_position_displayed_n_per_m} N/m",
     fit_press_wall},
    {"delay-seeds", "The worst of many seeds, over every round trip and every named link without an outage.",
     "master slave -link.impairment -hand -rendering.law -scene.material.stiffness_n_per_m", run_delay_seeds,
     delay_seeds_plots, "",
     "{held_within_5_percent} of {held_runs} runs within 5 %, worst {displayed_error_max*100} %; limit "
     "cycles {held_limit_cycles}, with a released handle {released_limit_cycles} of {released_runs}"},
    {"singular-paths",
     "The tool moves through the wrist, elbow and shoulder singularities of a PUMA 560: error and joint "
     "speeds.",
     "", run_singular_paths, singular_paths_plots, "",
     "error at most {wrist_off_goal_max_m*1e3} (wrist), {elbow_off_goal_max_m*1e3} (elbow), "
     "{shoulder_off_goal_max_m*1e3} mm (shoulder)"},
    {"sensor-faults",
     "A faulty force sensor on four arms in every state: how far does the robot move, how hard does it "
     "press?",
     "", run_sensor_faults, sensor_faults_plots, "",
     "{runs} runs: at most {way_max_m*1e3} mm of uncommanded motion and {true_force_over_guard} times the "
     "guard; a drift in contact responds like an approaching wall: {faked_answer_way_max_m*1e3} mm and "
     "{faked_answer_true_force_over_guard} times the guard; every fault reported within {told_late_max_s} "
     "s, {false_faults} false faults; a false force that responds to the motion moves the robot by "
     "{control_way_m*1e3} "
     "mm"},
    {"moving-wall",
     "A wall approaches a robot at rest, four arms, 0.1 to 50 mm/s, 200 to 20,000 N/m; walls of layers, "
     "moving hands; and the same with a wrong sign of the force sensor.",
     "", run_moving_wall, moving_wall_plots, "",
     "{runs} walls: force at most {force_over_guard_max} times the guard up to 250 N/s, and "
     "{force_over_bound_max} times the bound of the formula beyond; {layers_force_over_guard_max} times the "
     "guard where layers make the wall four times as stiff; {hand_moves_force_over_guard_max} and "
     "{hand_moves_layers_force_over_guard_max} times with {hand_moves_runs} moving hands; reported within "
     "{told_beside_stop_max_s} s of the stop, {false_signs} false sign faults; wrong sign found in "
     "{wrong_sign_found} of {wrong_sign_pressed}, at rest at {wrong_sign_at_rest_force_over_guard} times "
     "the guard; with a retreat of only 20 mm {control_force_over_guard} times the guard"},
    {"impact", "A mass hits a contact of any stiffness: restitution, energy and cost of four integrators.",
     "", run_impact, impact_plots, "",
     "{impacts} impacts; restitution correct in {discrete_gradient_right} % by the discrete gradient "
     "(error {discrete_gradient_error_max}), {rk4_right} % by Runge-Kutta, {semi_implicit_euler_right} %"
     " by semi-implicit Euler"},
    {"unknown-contact", "Random materials without a model: is the displayed contact correct?",
     "master slave -link.impairment -hand -mapping.scale -operator.press_n -operator.probe_n "
     "-operator.probe_cycles -sensing.force_noise_n -scene",
     run_unknown_contact, unknown_contact_plots, "",
     "{right} of {cells} within 5 % in slope and 10 % in mean force, worst {slope_error_max*100} and "
     "{force_error_max*100} %; the error is within 3 sd in {covered}, the sd is {sd_over_bound_median} "
     "times the Cramér-Rao bound; of {outside_cells} without a power law "
     "{outside_tangent_within_15_percent} are within 15 %"},
    {"material-steps",
     "Slide from soft to hard, press through layers: how soon is the new material identified?",
     "master slave -operator -hand -mapping.mode -mapping.scale -estimator.kind -scene", run_material_steps,
     material_steps_plots, "",
     "{layers_maximum_likelihood_followed} of {layers_maximum_likelihood_changes} layers reported within"
     " {layers_maximum_likelihood_slowest_s} s and {layers_maximum_likelihood_farthest_m*1e3} mm, the "
     "hard tile within {soft_to_hard_maximum_likelihood_slowest_s} s, the soft one within "
     "{hard_to_soft_maximum_likelihood_slowest_s} s of pressing; with a given exponent within "
     "{layers_fixed_exponent_slowest_s}, {soft_to_hard_fixed_exponent_slowest_s} and "
     "{hard_to_soft_fixed_exponent_slowest_s} s"},
    {"drag", "Unknown loads are dragged: is their inertia mistaken for a contact, is their mass identified?",
     "", run_drag_study, drag_plots, "",
     "{dragged} of {drags} dragged, {phantom_contacts} with a false contact, {holds} with a hold; mass "
     "within 5 % in {mass_within_5_percent} of {mass_above_noise} whose inertia is above 20 times the "
     "noise, within 3 sd in {mass_within_3_sd} of {mass_told}; a wall that the load touches is found "
     "within {wall_found_max_s} s"},
    {"free-motion",
     "Unknown force sensors in free motion: do noise, bias and drift cause false contacts, are real contacts found?",
     "", run_free_motion_study, free_motion_plots, "",
     "{false_contacts} false contacts in {moved_s} s of motion with {sensors} sensors; {walls_found} of {walls} walls "
     "found within 50 ms of twice the threshold, {slow_walls_found} of {slow_walls} at 0.1 mm/s; with a fixed "
     "threshold of 0.3 N {fixed_false_contacts} false contacts"},
    {"docking", "A free-floating spacecraft is grasped, dragged and docked across the link; three mistakes.",
     "master slave -operator -hand -mapping.mode -mapping.scale -rendering.ke "
     "-command.acceleration_max_m_per_s2 -command.speed_max_m_per_s -command.acceleration_max_rad_per_s2 "
     "-sensing.touch_n -sensing.release_n -robot -scene",
     run_docking, docking_plots, "Fig. 20, 21",
     "{docked} of {seeds} docked, displayed as a force of at least {felt_least_n} N that rises and "
     "vanishes; {mistakes_felt} of {mistakes} mistakes displayed, {mistakes_safe} safe; force at the "
     "tool at most {tool_force_max_n} N"},
    {"scenes-cost", "Time per step of each scene, and with 1 to 10,000 surfaces.", "", run_scenes_cost,
     scenes_cost_plots},
    {"trade", "Cost against error of each method of a stage: fronts, and the position of the defaults.",
     "device", run_trade, trade_plots, "",
     "presets FAST, BALANCED, EXACT: displayed stiffness error {accuracy_stiffness_fast_error}, "
     "{accuracy_stiffness_balanced_error}, {accuracy_stiffness_exact_error} % for walls of 500 to 4000 "
     "N/m, tracking error {accuracy_tracking_fast_error}, {accuracy_tracking_balanced_error}, "
     "{accuracy_tracking_exact_error} mm (rms); inverse of the arm within "
     "{arm_inverse_closed_form_error} of its reach, restitution within "
     "{contact_discrete_gradient_1000us_error}"},
};

}  // namespace

const std::vector<Experiment>& experiments() { return kExperiments; }

const Experiment* find_experiment(std::string_view name) {
  for (const Experiment& e : experiments()) {
    if (e.name == name) return &e;
  }
  return nullptr;
}

std::vector<Plot> plots_of(const Experiment& experiment, const std::vector<Metric>& metrics) {
  std::vector<Plot> plots = experiment.plots();
  for (Plot& plot : plots) {
    if (experiment.fit != nullptr) experiment.fit(plot, metrics);
  }
  return plots;
}

std::string_view outcome_of(const std::vector<Metric>& metrics) {
  const auto contact = std::ranges::find(metrics, "contact", &Metric::name);
  return contact != metrics.end() && contact->value == 0.0 ? "no contact" : "";
}

namespace {

/// Every field is set, even if it has its default, and no files are named, because their content is included.
proto::LabConfig spelled_out(const proto::LabConfig& config) {
  proto::LabConfig out;
  *out.mutable_master() = to_message(to_struct(config.master()));
  *out.mutable_slave() = to_message(to_struct(config.slave()));
  out.mutable_master()->clear_device_file();
  out.mutable_slave()->clear_robot_file();
  out.mutable_slave()->clear_scene_file();
  out.set_duration_s(config.duration_s());
  out.set_trace_hz(config.trace_hz());
  return out;
}

}  // namespace

std::string config_hash(const proto::LabConfig& config) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    spelled_out(config).SerializeToCodedStream(&coded);
  }
  return name_hash(bytes);
}

std::string_view commit() { return build_commit(); }

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw ConfigError("cannot create the folder " + folder.string() + ": " + error.message() +
                      "; choose another with --out");
}

std::vector<Metric> run_experiment(const Experiment& experiment, const ExperimentRun& run,
                                   const std::function<void(const std::string&)>& trouble) {
  if (!run.out.empty()) make_folder(run.out);
  std::vector<Metric> metrics = experiment.run(run);
  if (run.out.empty()) return metrics;
  std::ofstream file(run.out / "metrics.json", std::ios::trunc);
  file << metrics_json(experiment.name, run, metrics);
  if (!file.flush()) throw std::runtime_error("cannot write " + (run.out / "metrics.json").string());
  for (const Plot& plot : plots_of(experiment, metrics)) {
    if (plot.panels.empty()) continue;  // already drawn by the experiment
    if (const std::string why = draw(run.out, plot); !why.empty()) trouble(why);
  }
  return metrics;
}

std::string metrics_json(std::string_view experiment, const ExperimentRun& run,
                         const std::vector<Metric>& metrics) {
  nlohmann::ordered_json json;
  json["experiment"] = experiment;
  json["commit"] = commit();
  json["seed"] = run.seed;
  json["config_hash"] = config_hash(run.config);
  if (const std::string_view outcome = outcome_of(metrics); !outcome.empty()) json["outcome"] = outcome;
  json["metrics"] = nlohmann::ordered_json::object();
  for (const Metric& m : metrics) {
    json["metrics"][m.name] = {{"value", m.value}, {"unit", m.unit}};
    if (m.of_machine) json["metrics"][m.name]["of_machine"] = true;
  }
  return json.dump(2) + "\n";
}

}  // namespace longreach
