#include "deploy/lab/mapping/path_results.hpp"

#include "deploy/lab/campaign_size.hpp"
#include "deploy/lab/on_all_cores.hpp"

namespace longreach {

PathSize PathSize::chosen(int persons) {
  return {.persons = campaign(100, persons), .trials = campaign(2, 1)};
}

PathSample sample_paths(const proto::LabConfig& config, const PathCase& c, PathSize size,
                        const std::function<void(double)>& progress) {
  std::vector<PathResult> results(static_cast<std::size_t>(size.persons * size.trials));
  const auto one = [&](std::size_t i) {
    PathCase trial = c;
    trial.person = static_cast<int>(i) / size.trials;
    trial.trial = static_cast<int>(i) % size.trials;
    results[i] = run_path_trial(config, trial);
  };
  on_all_cores(results.size(), one, progress);

  PathSample sample;
  const auto persons = static_cast<std::size_t>(size.persons);
  sample.time_s.assign(persons, 0.0);
  sample.error_m.assign(persons, 0.0);
  sample.target_error_m.assign(persons, 0.0);
  sample.turned_rad.assign(persons, 0.0);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const PathResult& r = results[i];
    const std::size_t person = i / static_cast<std::size_t>(size.trials);
    sample.time_s[person] += r.time_s / size.trials;
    sample.error_m[person] += r.error_m / size.trials;
    sample.target_error_m[person] += r.target_error_m / size.trials;
    sample.turned_rad[person] += r.turned_rad / size.trials;
    sample.moves += r.moves / static_cast<double>(results.size());
    sample.relocations += r.relocations / static_cast<double>(results.size());
    sample.unfinished += !r.finished;
  }
  return sample;
}

std::vector<double> paired(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return d;
}

void add_spread(std::vector<Metric>& metrics, const std::string& name, const std::string& suffix,
                const std::vector<double>& sample, const std::string& unit) {
  const Spread s = spread_of(sample);
  metrics.push_back({name + "_" + suffix, s.mean, unit});
  metrics.push_back({name + "_sd_" + suffix, s.sd, unit});
}

}  // namespace longreach
