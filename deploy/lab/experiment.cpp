#include "deploy/lab/experiment.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/config/config.hpp"
#include "common/recording/build_name.hpp"
#include "deploy/lab/mapping/path_answer.hpp"
#include "deploy/lab/name_hash.hpp"

namespace longreach {
namespace {

const std::vector<Experiment> kExperiments = {
    {"touch",
     "Is the displayed stiffness correct when a simulated operator touches, presses on and probes a wall?",
     "master slave robot.mjcf duration_s trace_hz", run_touch, touch_plots, "",
     "At a round-trip time of {rtt_s} s, a wall of {reference_stiffness_n_per_m} N/m is displayed as "
     "{displayed_stiffness_n_per_m} N/m, and its surface is located within "
     "{wall_registration_error_m*1e6} µm."},
    {"first-touch",
     "What does the operator feel when the tool first hits a wall at 50 mm/s, at a round-trip time of 3 s?",
     "master slave -link.impairment -operator -hand -mapping.mode -mapping.scale -rendering.registration "
     "-scene.material.stiffness_n_per_m -scene.surface",
     run_first_touch, first_touch_plots, "",
     "The operator feels the wall one round trip ({round_trip_s} s) plus {felt_after_round_trip_s} s "
     "after the goal reaches it; the largest force step is {force_step_max_n} N. The wall is located "
     "within {registration_error_m*1e6} µm, or within "
     "{registration_error_without_touch_sequence_m*1e3} mm if the touch sequence is ignored. The "
     "force at the tool is at most {guard_peak_over_guard_max} times the limit of the force guard, or "
     "{guard_peak_over_guard_max_without_guard} times this limit with the guard off."},
    {"spike",
     "What happens to the force and the energy if the round-trip time jumps from 0.8 to 12 s "
     "during contact?",
     "master slave -link.impairment -operator.rate_distance_m -operator.probe_cycles -scene.surface.plane",
     run_spike, spike_plots, "",
     "{stiffness_left_after_time_constant*100} % of the stiffness remains after one time constant, "
     "and the force rises by at most {force_rise_max_n} N per tick. The operator engages "
     "{engagements} times in total, and presses on the wall again in {pressed_again} of 1 runs."},
    {"person",
     "Is contact handled correctly when the operator holds the handle deflected, rests, retreats, uses "
     "the clutch or releases the handle?",
     "master slave robot.mjcf -link.impairment -operator -hand -mapping.mode -scene", run_person_experiment,
     person_plots, "",
     "{failed} of {trials} trials fail ({rows} scenarios, five links, light and firm hands). As a "
     "control, {controls_failed} of {controls} trials fail if the reports lack the position of the tool.",
     nullptr, true},
    {"rate-contact", "In rate mode, does the operator feel the force with which the tool presses on a wall?",
     "master slave -operator -hand -mapping.mode -scene.surface.plane", run_rate_contact, rate_contact_plots,
     "", "The hand feels {ratio_min} to {ratio_max} of the force at the tool (off: {control_spread} times)."},
    {"six-dof-contact",
     "Is the displayed force correct on an oblique plane, in corners and at a rotational stop, without a "
     "model of the scene?",
     "master slave -operator -hand -mapping.mode -mapping.scale -rendering.friction_n -rendering.friction_nm "
     "-rendering.rotational_stiffness_nm_per_rad -scene",
     run_six_dof_contact, six_dof_contact_plots, "",
     "The force error is {oblique_force_error*100} % on an oblique plane, {corner_60_force_error*100}, "
     "{corner_90_force_error*100} and {corner_120_force_error*100} % in corners of 60, 90 and 120 degrees, "
     "{three_walls_force_error*100} % at three walls, and {diagonal_force_error*100} % in a corner whose walls are touched "
     "at once. The slope error is {oblique_displayed_error*100} % on the plane, {corner_60_slope_error*100}, "
     "{corner_90_slope_error*100}, {corner_120_slope_error*100}, {three_walls_slope_error*100} and "
     "{diagonal_slope_error*100} % there, and {torque_displayed_error*100} % in torsion."},
    {"tensor-rendering", "How large is the error of the rendering alone, with exact surface reports?",
     "device mapping rendering -mapping.mode -mapping.scale -rendering.friction_n "
     "-rendering.rotational_stiffness_nm_per_rad",
     run_tensor_rendering, tensor_rendering_plots, "",
     "The error is {oblique_displayed_error*100} % on an oblique plane, "
     "{corner_displayed_error_x*100} and {corner_displayed_error_y*100} % (x and y) in a corner, and "
     "{torque_displayed_error*100} % in torsion."},
    {"hostile-updates",
     "Does the rendering remain passive, with limited force, under half a million hostile stiffness "
     "reports?",
     "device rendering mapping -device.delay_samples -rendering.law", run_hostile_updates,
     hostile_updates_plots, "",
     "{updates*1e-6} million reports cause {unsafe_wrenches} unsafe wrenches. The minimum port energy is "
     "{port_energy_min_j*1e3} mJ; without the passivity rules, it is {naive_port_energy_min_j} J."},
    {"idle",
     "While the hand is at rest, does the rendering return energy, cause force ripple or enter a limit "
     "cycle?",
     "mapping rendering -mapping.mode -mapping.rate_centre -mapping.scale -rendering.home_spring", run_idle,
     idle_plots, "",
     "{bad} of {draws} random combinations of device, position, grip and wall fail. The returned "
     "energy exceeds the initial store by at most {energy_out_max_j*1e3} mJ. The force ripple minus "
     "the ripple caused by one encoder count is at most {ripple_beyond_a_count_max_n*1e3} mN. As a "
     "control, {control_bad} of {control_draws} combinations fail if the damping uses the raw encoder "
     "velocity."},
    {"home-rotation",
     "How do damping and stiffness affect the return of the rotational handle to its home position?",
     "device", run_home_rotation, home_rotation_plots, "Fig. 9, 10",
     "The settling time differs from the closed-form solution by at most {settling_difference_max*100} %. "
     "The overshoot is {overshoot_at_0.5*100} % at a damping ratio of {zeta_at_0.5}."},
    {"home-translation",
     "How does the translational handle return to its home position with a fixed spring and with a moving "
     "anchor?",
     "device", run_home_translation, home_translation_plots, "Fig. 17",
     "With a fixed spring, the settling time differs from the closed-form solution by at most "
     "{settling_difference_max*100} %. With a moving anchor, the handle stops {left_gliding*1e3} mm from "
     "its home position."},
    {"wall-rotation", "How far into a virtual wall can a light grip rotate the handle?", "device",
     run_wall_rotation, wall_rotation_plots, "Fig. 11, 12",
     "At a stiffness of 20 mN m per degree, the depth is {depth_at_20} degrees; the expected depth is "
     "{depth_expected_at_20} degrees."},
    {"wall-translation",
     "How do sample time, grip, delay, encoders and friction limit the stable stiffness of a virtual "
     "wall?",
     "device", run_wall_translation, wall_translation_plots, "Fig. 18",
     "The stability limit differs from that of the sampled model by at most {limit_difference_max*100} %. "
     "At 1 kHz the limit is {paper_wall_limit_light*1e-3} N/mm with a light hand, "
     "{paper_wall_limit_firm*1e-3} N/mm with a firm hand and {paper_wall_limit_released*1e-3} N/mm with a "
     "released handle."},
    {"gravity",
     "How far does the released translational handle drift, with and without gravity "
     "compensation?",
     "device", run_gravity, gravity_plots, "Fig. 15, 16",
     "The handle drifts by {drift_real_max*1e6} µm with compensation and by "
     "{drift_without_compensation*1e3} mm without it. The motor torque at home is {torque_home_1} mN m; "
     "the source paper reports {torque_paper_home_1} to {torque_paper_home_3} mN m."},
    {"rate-mapping",
     "How does the speed of the robot in rate mode depend on the deflection of the handle, for two "
     "control laws?",
     "master slave -operator -hand -mapping.mode -mapping.rate_law", run_rate_mapping, rate_mapping_plots,
     "Fig. 13, 14",
     "At the edge of the dead zone, the speed jumps by {speed_step_translation_continuous*1e3} mm/s "
     "under the continuous law and by {speed_step_translation_literal*1e3} mm/s under the literal law."},
    {"scale-steps",
     "When a button changes the scale during motion, does the goal or the force jump, and does the "
     "friction become f / k_scale?",
     "master slave -operator -mapping.mode", run_scale_steps, scale_steps_plots, "",
     "Over {scale_steps} scale changes, the goal jumps by at most {goal_step_max_m} m and the force by at "
     "most {force_step_max_n} N. The friction differs from f / k_scale by at most "
     "{friction_error_max*100} %."},
    {"path-task",
     "How fast and how accurately do simulated operators follow a path in rate, position and hybrid mode?",
     "master slave -link.impairment -operator -mapping.mode -mapping.rate_centre -mapping.simultaneous "
     "-mapping.base_rotation_rad -robot -scene",
     run_path_task, path_task_plots, "Fig. 19, Table 2", kPathTaskAnswer},
    {"mapping-trade",
     "How do kv, k_scale, the dead zone and the switching distance of hybrid mode affect time and error?",
     "master slave -link.impairment -operator -mapping.kv_per_s -mapping.scale -mapping.dead_zone_m "
     "-mapping.mode -mapping.rate_centre -mapping.base_rotation_rad -robot -scene",
     run_mapping_trade, mapping_trade_plots, "",
     "At a round trip of {rtt_s} s, the path error in rate mode is {rate_kv_per_s_error_m_at_0.5*1e3} "
     "mm with kv = 0.5/s and {rate_kv_per_s_error_m_at_4*1e3} mm with kv = 4/s. Position mode takes "
     "{position_k_scale_time_s_at_0.2} s (path error {position_k_scale_error_m_at_0.2*1e3} mm) with "
     "k_scale = 0.2 and {position_k_scale_time_s_at_1} s ({position_k_scale_error_m_at_1*1e3} mm) "
     "with k_scale = 1. Hybrid mode takes {hybrid_near_sd_time_s_at_0} s "
     "({hybrid_near_sd_error_m_at_0*1e3} mm) if it stays in rate mode up to the target, and "
     "{hybrid_near_sd_time_s_at_4} s ({hybrid_near_sd_error_m_at_4*1e3} mm) if it switches 4 standard "
     "deviations before the target."},
    {"fk-network",
     "Which forward kinematics method for the 3-RRR device is the most accurate, and what does it cost?", "",
     run_fk_network, fk_network_plots, "",
     "The maximum error is {tracking_error_max_rad} rad for tracking, {network_error_max_rad} rad for "
     "the network, and {network_newton_error_max_rad} rad for the network followed by one Newton step."},
    {"identify",
     "How accurately do seven estimators identify a contact, compared with a batch fit and the "
     "Cramér-Rao bound?",
     "", run_identify, identify_plots, "",
     "During probing, the maximum stiffness errors are: maximum likelihood "
     "{stiffness_error_worst_maximum_likelihood_probe} %, batch fit {stiffness_error_worst_batch_probe} "
     "%, extended Kalman filter {stiffness_error_worst_extended_kalman_probe} %, weighted log-linear "
     "{stiffness_error_worst_weighted_log_linear_probe} %, log-linear "
     "{stiffness_error_worst_log_linear_probe} %, two-stage {stiffness_error_worst_two_stage_probe} %."},
    {"synthesis",
     "Which search finds the best dimensions of a DELTA device: a genetic algorithm, SQP, or both in "
     "sequence?",
     "", run_synthesis, synthesis_plots, "",
     "The worst conditioning in a 60 mm cube is {a_conditioning} for the best design and "
     "{catalog_conditioning} for the reconstructed device."},
    {"delay-sweep", "How stiff a wall can longreach and five textbook laws display at each delay?",
     "master slave -link.impairment.delay_s -hand -rendering.law -scene.material.stiffness_n_per_m",
     run_delay_sweep, delay_sweep_plots, "",
     "longreach displays the stiffness to within 5 % in {stiffness_within_5_percent} of "
     "{stiffness_cases} cases. At a round trip of 3 s, direct force feedback displays at most "
     "{direct_limit_at_3*1e-3} N/mm and wave variables {wave_limit_at_3*1e-3} N/mm."},
    {"press-wall",
     "How does a wall feel across a link with each textbook law, or with the one selected by rendering.law?",
     "device hand rendering.law link.impairment.delay_s link.impairment.jitter_s link.impairment.loss "
     "scene.material.stiffness_n_per_m",
     run_press_wall, press_wall_plots, "",
     "For a wall of {wall_n_per_m} N/m at a round trip of {rtt_s} s, direct force feedback returns "
     "{direct_port_energy_min_j*-1} J to the operator. Passivity control displays "
     "{tdpa_displayed_n_per_m} N/m and position-position control "
     "{position_position_displayed_n_per_m} N/m.",
     fit_press_wall},
    {"delay-seeds",
     "Is the displayed stiffness correct with every seed, at each round-trip time and over each named "
     "link without outages?",
     "master slave -link.impairment -hand -rendering.law -scene.material.stiffness_n_per_m", run_delay_seeds,
     delay_seeds_plots, "",
     "In {held_within_5_percent} of {held_runs} runs, the displayed stiffness is correct to within 5 "
     "%; the maximum error is {displayed_error_max*100} %. Limit cycles occur in {held_limit_cycles} "
     "of these runs, and in {released_limit_cycles} of {released_runs} runs with a released handle."},
    {"singular-paths",
     "How large is the error when the tool passes through the wrist, elbow and shoulder singularities "
     "of a PUMA 560?",
     "", run_singular_paths, singular_paths_plots, "",
     "The position error is at most {wrist_off_goal_max_m*1e3} mm at the wrist singularity, "
     "{elbow_off_goal_max_m*1e3} mm at the elbow and {shoulder_off_goal_max_m*1e3} mm at the shoulder "
     "singularity."},
    {"sensor-faults",
     "If the force sensor is faulty, how far does the robot move without a command, and how hard does "
     "it press?",
     "", run_sensor_faults, sensor_faults_plots, "",
     "In {runs} runs the robot moves by at most {way_max_m*1e3} mm without a command and presses with "
     "at most {true_force_over_guard} times the limit of the force guard. If the sensor drifts in "
     "contact, which resembles an approaching wall, the corresponding values are "
     "{faked_answer_way_max_m*1e3} mm and {faked_answer_true_force_over_guard}. Implausible forces "
     "are reported within {told_late_max_s} s, with {false_faults} false alarms. As a control, a "
     "false force that decreases as the robot moves displaces the robot by {control_way_m*1e3} mm."},
    {"moving-wall",
     "Does the contact force stay limited when a wall approaches the robot, even if the force sensor has "
     "the wrong sign?",
     "", run_moving_wall, moving_wall_plots, "",
     "With {runs} walls, the force is at most {force_over_guard_max} times the guard limit if it grows by "
     "up to 250 N/s, and {force_over_bound_max} times the theoretical bound if it grows faster. It is at "
     "most {layers_force_over_guard_max} times the guard limit if a layer makes the wall four times as "
     "stiff. In {hand_moves_runs} runs with a moving hand it is at most {hand_moves_force_over_guard_max} "
     "times the guard limit, or {hand_moves_layers_force_over_guard_max} times with layers. The robot "
     "reports that its retreat budget is exhausted within {told_beside_stop_max_s} s of stopping. A wrong "
     "sign is detected in {wrong_sign_found} of {wrong_sign_pressed} runs, at a force of at most "
     "{wrong_sign_at_rest_force_over_guard} times the guard limit if the wall is at rest; there are "
     "{false_signs} false alarms. If the robot may retreat by only 20 mm, the force reaches "
     "{control_force_over_guard} times the guard limit."},
    {"impact",
     "Which of four integrators computes the restitution of an impact correctly, and at what "
     "cost?",
     "", run_impact, impact_plots, "",
     "The discrete gradient computes the correct restitution for {discrete_gradient_right} % of {impacts} "
     "impacts (maximum error {discrete_gradient_error_max}), Runge-Kutta for {rk4_right} % and "
     "semi-implicit Euler for {semi_implicit_euler_right} %."},
    {"unknown-contact",
     "Is the displayed contact correct for random materials, without a model of the material?",
     "master slave robot.mjcf -link.impairment -hand -mapping.scale -operator.press_n -operator.probe_n "
     "-operator.probe_cycles -sensing.force_noise_n -scene",
     run_unknown_contact, unknown_contact_plots, "",
     "In {right} of {cells} cases the slope is within 5 % and the mean force within 10 %; the maximum "
     "errors are {slope_error_max*100} and {force_error_max*100} %. The error of the estimate is within 3 "
     "sd in {covered} cases, and the median sd is {sd_over_bound_median} times the Cramér-Rao bound. Of "
     "{outside_cells} materials that do not follow a power law, {outside_tangent_within_15_percent} are "
     "displayed within 15 %."},
    {"material-steps",
     "How quickly is a new material identified when the tool slides onto it or presses through a layer?",
     "master slave -operator -hand -mapping.mode -mapping.scale -estimator.kind -scene", run_material_steps,
     material_steps_plots, "",
     "{layers_maximum_likelihood_followed} of {layers_maximum_likelihood_changes} layers are reported "
     "within {layers_maximum_likelihood_slowest_s} s and {layers_maximum_likelihood_farthest_m*1e3} mm, a "
     "hard tile within {soft_to_hard_maximum_likelihood_slowest_s} s, and a soft tile within "
     "{hard_to_soft_maximum_likelihood_slowest_s} s after pressing begins. If the exponent is given, "
     "these times are {layers_fixed_exponent_slowest_s}, {soft_to_hard_fixed_exponent_slowest_s} and "
     "{hard_to_soft_fixed_exponent_slowest_s} s."},
    {"drag", "Is the mass of a dragged load identified, and is its inertia ever mistaken for a contact?",
     "master slave robot.mjcf -link.impairment -operator -hand -mapping.mode -mapping.scale "
     "-rendering.load_factor -sensing.force_noise_n -sensing.moment_noise_nm "
     "-command.acceleration_max_m_per_s2 -scene",
     run_drag_study, drag_plots, "",
     "The load is dragged successfully in {dragged} of {drags} runs with unknown loads; a false contact is "
     "reported in {phantom_contacts} runs, and {holds} are interrupted by a hold. The mass is within 5 % for "
     "{mass_within_5_percent} of {mass_above_noise} loads with an inertial force above 20 times the noise, "
     "and within 3 sd for {mass_within_3_sd} of {mass_told} reported loads. A wall that the load touches at 10 "
     "mm/s is detected within {known_wall_found_max_s} s if the mass is known, and within {wall_found_max_s} s "
     "if it is not."},
    {"free-motion",
     "Do noise, bias or drift of an unknown force sensor cause false contacts, and are real contacts "
     "detected?",
     "", run_free_motion_study, free_motion_plots, "",
     "{false_contacts} false contacts occur in {moved_s} s of motion with {sensors} sensors. "
     "{walls_found} of {walls} walls are detected within 50 ms after the force reaches twice the "
     "threshold, and {slow_walls_found} of {slow_walls} walls at 0.1 mm/s. A fixed threshold of 0.3 N "
     "causes {fixed_false_contacts} false contacts."},
    {"docking",
     "Can an operator dock a free-floating spacecraft across the link and feel when a mistake is made?",
     "master slave robot.mjcf -operator -hand -mapping.mode -rendering.ke_by_scale -robot -scene",
     run_docking, docking_plots, "Fig. 20, 21",
     "{docked} of {seeds} spacecraft are docked; the operator feels the latch engage as a force that "
     "rises to at least {felt_least_n} N and vanishes. Of {mistakes} deliberate mistakes, the operator "
     "feels {mistakes_felt}, and {mistakes_safe} have no dangerous effect. The contact force is at most "
     "{pressed_max_n} N; with the inertial force of the spacecraft, the force at the tool is at most "
     "{tool_force_max_n} N."},
    {"scenes-cost", "How long does a simulation step take in each scene, and with 1 to 10,000 surfaces?", "",
     run_scenes_cost, scenes_cost_plots},
    {"trade", "Are the default methods on the Pareto front of cost versus error?", "device", run_trade,
     trade_plots, "",
     "With the presets FAST, BALANCED and EXACT, the error of the displayed stiffness is "
     "{accuracy_stiffness_fast_error}, {accuracy_stiffness_balanced_error} and "
     "{accuracy_stiffness_exact_error} % for walls of 500 to 4000 N/m, and the rms tracking error is "
     "{accuracy_tracking_fast_error}, {accuracy_tracking_balanced_error} and "
     "{accuracy_tracking_exact_error} mm. The error of the inverse kinematics is "
     "{arm_inverse_closed_form_error} of the reach, and the restitution error is "
     "{contact_discrete_gradient_1000us_error}."},
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
                      "; choose another folder with --out");
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
