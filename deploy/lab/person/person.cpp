// Behaviour of people that the other experiments do not simulate: compliant hands that rest, retreat, clutch
// and release, over five links. The results are compared with the true scene.

#include <algorithm>
#include <fstream>

#include "common/config/config.hpp"
#include "common/config/link_profile.hpp"
#include "common/core/random.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/mjcf_robots.hpp"
#include "deploy/lab/on_all_cores.hpp"
#include "deploy/lab/person/person_rows.hpp"

namespace longreach {
namespace {

constexpr double kFreeMost_n = 0.1;
const std::vector<std::string> kLinks = {"lab", "kontur", "gateway", "moon", "etsvii"};

struct Trial {
  const PersonRow* row;
  std::string link;
  Grip grip;
  bool blind;  // the control without positions in the reports
  std::vector<PersonCheck> checks{};
  std::string left_out{};  // why a robot of an MJCF file does not run it; empty: it ran
  [[nodiscard]] std::string name() const {
    return std::string(row->name) + ',' + link + ',' + (grip == Grip::kFirm ? "firm" : "light");
  }
  [[nodiscard]] bool holds() const {
    return std::ranges::all_of(checks, [](const PersonCheck& c) { return c.value <= c.most; });
  }
};

void run_trial(const ExperimentRun& run, Trial& trial) {
  proto::LabConfig config = run.config;
  const proto::LinkProfile link = load_link_profile(find_deploy_folder(), trial.link);
  take_profile(*config.mutable_master()->mutable_link(), link);
  take_profile(*config.mutable_slave()->mutable_link(), link);
  PersonScenario scenario;
  scenario.master = to_struct(config.master());
  scenario.slave = to_struct(config.slave());
  scenario.grip = scenario.master.hand.grip = trial.grip;
  scenario.rtt_s = link.up().delay_s() + link.down().delay_s();
  scenario.seed = run.seed;
  scenario.blind = trial.blind;
  // A robot of an MJCF file has no scene of its own, and each row has the material of its surfaces.
  if (scenario.slave.scene.material.empty()) scenario.slave.scene.material.resize(1);
  trial.row->prepare(scenario);
  // Otherwise the commanded force bounds the goal, too.
  if (trial.blind) scenario.master.rendering.rate_force_ratio = 0.0;
  try {
    const PersonSeen seen = run_person(scenario);
    trial.checks = trial.row->judge(scenario, seen);
    trial.checks.push_back({"contact force although the tool is free, N", seen.free_n, kFreeMost_n});
  } catch (const UnsuitableScene& reason) {
    trial.left_out = reason.what();
  }
}

void write_table(const std::filesystem::path& out, const std::vector<Trial>& trials) {
  if (out.empty()) return;
  std::ofstream file(out / "person.csv", std::ios::trunc);
  file << "row,link,hand,control,check,value,most,holds\n";
  for (const Trial& t : trials) {
    if (!t.left_out.empty())
      file << t.name() << ',' << (t.blind ? 1 : 0) << ",\"left out: " << t.left_out << "\",0,0,\n";
    for (const PersonCheck& c : t.checks)
      file << t.name() << ',' << (t.blind ? 1 : 0) << ",\"" << c.what << "\"," << c.value << ',' << c.most
           << ',' << (c.value <= c.most ? 1 : 0) << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + (out / "person.csv").string());
}

std::vector<Trial> all_trials(const ExperimentRun& run) {
  std::vector<Trial> trials;
  for (const PersonRow& row : person_rows()) {
    std::vector<Trial> of_row;
    for (const std::string& link : kLinks)
      for (const Grip grip : {Grip::kLight, Grip::kFirm}) of_row.push_back({&row, link, grip, false});
    if (run.sample) of_row = {of_row[Random(run.seed).child(row.name).next() % of_row.size()]};
    for (const Trial& trial : of_row) {
      trials.push_back(trial);
      if (!row.by_place) continue;
      trials.push_back(trial);
      trials.back().blind = true;
    }
  }
  return trials;
}

}  // namespace

std::vector<Metric> run_person_experiment(const ExperimentRun& run) {
  std::vector<Trial> trials = all_trials(run);
  std::erase_if(trials, [&](const Trial& t) { return t.name().find(run.only) == std::string::npos; });
  if (trials.empty())
    throw ConfigError("--only " + run.only + " matches no trial; an example is slot,kontur,firm");
  on_all_cores(
      trials.size(), [&](std::size_t i) { run_trial(run, trials[i]); }, run.progress);
  write_table(run.out, trials);
  for (const Trial& t : trials)
    for (const PersonCheck& c : t.checks)
      if (run.check && !t.blind) run.check({t.name(), c.what, c.value, c.most});
  const auto count = [&](const auto& which) {
    return static_cast<double>(std::ranges::count_if(trials, which));
  };
  std::vector<Metric> metrics;
  for (const PersonRow& row : person_rows()) {
    const auto of_row = [&row](const Trial& t) { return t.row == &row && !t.blind; };
    const double left_out = count([&](const Trial& t) { return of_row(t) && !t.left_out.empty(); });
    if (left_out > 0.0) metrics.push_back({"left_out_" + std::string(row.name), left_out, ""});
    if (left_out > 0.0) continue;
    metrics.push_back({"failed_" + std::string(row.name),
                       count([&](const Trial& t) { return of_row(t) && !t.holds(); }), ""});
  }
  metrics.push_back({"rows", static_cast<double>(person_rows().size()), ""});
  metrics.push_back({"trials", count([](const Trial& t) { return !t.blind && t.left_out.empty(); }), ""});
  metrics.push_back({"failed", count([](const Trial& t) { return !t.blind && !t.holds(); }), ""});
  metrics.push_back({"controls", count([](const Trial& t) { return t.blind && t.left_out.empty(); }), ""});
  metrics.push_back({"controls_failed", count([](const Trial& t) { return t.blind && !t.holds(); }), ""});
  return metrics;
}

std::vector<Plot> person_plots() { return {}; }

}  // namespace longreach
