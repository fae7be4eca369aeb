#pragma once
// An experiment of the laboratory. It consists of a name, a summary, plots, and a function that computes
// metrics from (config, seed) and may write traces to the output folder.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/lab/plot.hpp"
#include "proto/config.pb.h"

namespace longreach {

struct Metric {
  std::string name;
  double value = 0.0;
  std::string unit;         // empty for a dimensionless number
  bool of_machine = false;  // a measured time or a ratio of times, which varies from run to run
};

/// A requirement on one trial of an experiment. It holds if `value` <= `most`.
struct TrialCheck {
  std::string trial;  // name of the trial, for example "slot,kontur,firm"
  std::string what;   // quantity and unit
  double value = 0.0, most = 0.0;
  [[nodiscard]] bool holds() const { return value <= most; }
};

struct ExperimentRun {
  proto::LabConfig config;  // complete configuration, with files and link profile resolved
  std::uint64_t seed = 1;
  std::filesystem::path out;  // existing folder for the traces; empty: write no traces
  /// Called with the completed fraction of the work, 0 to 1; may be empty.
  std::function<void(double done)> progress;
  /// Runs only the trials whose names contain this text; empty: all. Only for experiments with `trials`.
  std::string only;
  bool sample = false;  // `person`: each row once, over a link and with a grip drawn from the seed
  /// Called in the calling thread with each check of each trial; may be empty. Only for experiments with `trials`.
  std::function<void(const TrialCheck& check)> check;
};

struct Experiment {
  std::string_view name;
  std::string_view summary;
  // The parts of the configuration that the experiment uses: paths of groups and fields, which apply to both
  // sides if no side is given. A minus sign marks parts that the experiment sets itself or ignores
  // (settings_used.hpp). robot.mjcf, which replaces the scene, counts only where it is named. Empty: none.
  std::string_view uses;
  std::vector<Metric> (*run)(const ExperimentRun&);
  std::vector<Plot> (*plots)();
  /// Figure of the source paper (Liu et al. 2019) that the experiment reproduces; empty: none.
  std::string_view figure{};
  /// Sentence for the report; {NAME} stands for a metric, {NAME*1e3} for a multiple of it.
  std::string_view answer{};
  void (*fit)(Plot&, const std::vector<Metric>&) = nullptr;  // adapts a plot to the results; may be null
  bool trials = false;  // consists of named trials with checks, see ExperimentRun
};

/// Returns the plots of an experiment, adapted to the results of a run.
std::vector<Plot> plots_of(const Experiment& experiment, const std::vector<Metric>& metrics);

/// Returns all experiments in the order of `longreach-lab list`.
const std::vector<Experiment>& experiments();
const Experiment* find_experiment(std::string_view name);

/// Returns a complete configuration from settings of the form "path=value", in the same order as for the programs
/// (common/config/effective.hpp). Relative file names are first looked up in `from`. Throws ConfigError, also for a
/// setting that another setting makes ineffective.
proto::LabConfig configure(const std::vector<std::string>& settings,
                           const std::filesystem::path& deploy_folder,
                           const std::filesystem::path& from = std::filesystem::current_path());

/// Returns "no contact" if the intended contact did not occur in the run, otherwise an empty string.
std::string_view outcome_of(const std::vector<Metric>& metrics);

/// Returns an identifier of a configuration: the 64-bit FNV-1a hash of its deterministic serialisation as 16
/// hexadecimal digits.
std::string config_hash(const proto::LabConfig& config);

/// Returns the commit of the build, with "-dirty" appended if the working tree was modified.
std::string_view commit();

/// Creates the folder if it does not exist. Throws a ConfigError that names --out if that fails.
void make_folder(const std::filesystem::path& folder);

/// Runs an experiment. Writes traces, metrics.json and the plots to `run.out`, unless this path is empty.
/// `trouble` is called with a message for each plot that could not be drawn. Throws std::runtime_error if a
/// file cannot be written, and ConfigError if the folder cannot be created.
std::vector<Metric> run_experiment(const Experiment& experiment, const ExperimentRun& run,
                                   const std::function<void(const std::string&)>& trouble);

std::string metrics_json(std::string_view experiment, const ExperimentRun& run,
                         const std::vector<Metric>& metrics);

// The experiments.
std::vector<Metric> run_touch(const ExperimentRun& run);
std::vector<Plot> touch_plots();
std::vector<Metric> run_hostile_updates(const ExperimentRun& run);
std::vector<Plot> hostile_updates_plots();
std::vector<Metric> run_idle(const ExperimentRun& run);
std::vector<Plot> idle_plots();
std::vector<Metric> run_first_touch(const ExperimentRun& run);
std::vector<Plot> first_touch_plots();
std::vector<Metric> run_person_experiment(const ExperimentRun& run);
std::vector<Plot> person_plots();
std::vector<Metric> run_spike(const ExperimentRun& run);
std::vector<Plot> spike_plots();
std::vector<Metric> run_rate_contact(const ExperimentRun& run);
std::vector<Plot> rate_contact_plots();
std::vector<Metric> run_six_dof_contact(const ExperimentRun& run);
std::vector<Plot> six_dof_contact_plots();
std::vector<Metric> run_tensor_rendering(const ExperimentRun& run);
std::vector<Plot> tensor_rendering_plots();
std::vector<Metric> run_home_rotation(const ExperimentRun& run);
std::vector<Plot> home_rotation_plots();
std::vector<Metric> run_home_translation(const ExperimentRun& run);
std::vector<Plot> home_translation_plots();
std::vector<Metric> run_wall_rotation(const ExperimentRun& run);
std::vector<Plot> wall_rotation_plots();
std::vector<Metric> run_wall_translation(const ExperimentRun& run);
std::vector<Plot> wall_translation_plots();
std::vector<Metric> run_gravity(const ExperimentRun& run);
std::vector<Plot> gravity_plots();
std::vector<Metric> run_rate_mapping(const ExperimentRun& run);
std::vector<Plot> rate_mapping_plots();
std::vector<Metric> run_scale_steps(const ExperimentRun& run);
std::vector<Plot> scale_steps_plots();
std::vector<Metric> run_path_task(const ExperimentRun& run);
std::vector<Plot> path_task_plots();
std::vector<Metric> run_mapping_trade(const ExperimentRun& run);
std::vector<Plot> mapping_trade_plots();
std::vector<Metric> run_fk_network(const ExperimentRun& run);
std::vector<Plot> fk_network_plots();
std::vector<Metric> run_identify(const ExperimentRun& run);
std::vector<Plot> identify_plots();
std::vector<Metric> run_synthesis(const ExperimentRun& run);
std::vector<Plot> synthesis_plots();

std::vector<Metric> run_delay_sweep(const ExperimentRun& run);
std::vector<Plot> delay_sweep_plots();
std::vector<Metric> run_press_wall(const ExperimentRun& run);
std::vector<Plot> press_wall_plots();
void fit_press_wall(Plot& plot, const std::vector<Metric>& metrics);
std::vector<Metric> run_delay_seeds(const ExperimentRun& run);
std::vector<Plot> delay_seeds_plots();
std::vector<Metric> run_singular_paths(const ExperimentRun& run);
std::vector<Plot> singular_paths_plots();
std::vector<Metric> run_sensor_faults(const ExperimentRun& run);
std::vector<Plot> sensor_faults_plots();
std::vector<Metric> run_moving_wall(const ExperimentRun& run);
std::vector<Plot> moving_wall_plots();
std::vector<Metric> run_impact(const ExperimentRun& run);
std::vector<Plot> impact_plots();
std::vector<Metric> run_unknown_contact(const ExperimentRun& run);
std::vector<Plot> unknown_contact_plots();
std::vector<Metric> run_material_steps(const ExperimentRun& run);
std::vector<Plot> material_steps_plots();
std::vector<Metric> run_scenes_cost(const ExperimentRun& run);
std::vector<Plot> scenes_cost_plots();
std::vector<Metric> run_trade(const ExperimentRun& run);
std::vector<Plot> trade_plots();
std::vector<Metric> run_drag_study(const ExperimentRun& run);
std::vector<Plot> drag_plots();
std::vector<Metric> run_free_motion_study(const ExperimentRun& run);
std::vector<Plot> free_motion_plots();
std::vector<Metric> run_docking(const ExperimentRun& run);
std::vector<Plot> docking_plots();

}  // namespace longreach
