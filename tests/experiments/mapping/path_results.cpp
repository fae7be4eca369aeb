#include "tests/experiments/mapping/path_results.hpp"

#include "tests/property/campaign.hpp"

namespace longreach {

PathSize PathSize::chosen() { return {.persons = campaign(100, 6), .trials = campaign(2, 1)}; }

PathSample sample_paths(const proto::LabConfig& config, PathCase c, PathSize size,
                        const std::function<void()>& done) {
  PathSample sample;
  const double share = 1.0 / size.trials;
  for (c.person = 0; c.person < size.persons; ++c.person) {
    double time_s = 0.0, error_m = 0.0, target_error_m = 0.0;
    for (c.trial = 0; c.trial < size.trials; ++c.trial) {
      const PathResult r = run_path_trial(config, c);
      time_s += share * r.time_s;
      error_m += share * r.error_m;
      target_error_m += share * r.target_error_m;
      sample.moves += share * r.moves / size.persons;
      sample.relocations += share * r.relocations / size.persons;
      sample.unfinished += !r.finished;
      done();
    }
    sample.time_s.push_back(time_s);
    sample.error_m.push_back(error_m);
    sample.target_error_m.push_back(target_error_m);
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
