#pragma once
// A laboratory that engages on request, used by the clock tests.

#include <memory>
#include <string>
#include <vector>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/laboratory.hpp"

namespace longreach::clocks {

struct Bench {
  explicit Bench(std::vector<std::string> settings, std::uint64_t seed = 1) {
    settings.emplace_back("safety.engage_at_start=false");
    const proto::LabConfig config = configure(settings, LONGREACH_DEPLOY);
    slave = to_struct(config.slave());
    lab = std::make_unique<Laboratory>(to_struct(config.master()), slave, seed);
  }
  SlaveConfig slave;
  std::unique_ptr<Laboratory> lab;
};

inline void run(Laboratory& lab, double seconds) {
  const double end_s = lab.now_s() + seconds - 0.5 * lab.period_s();
  while (lab.now_s() < end_s) lab.step();
}

inline bool both(const Laboratory& lab, SafetyState state) {
  return lab.master().state == state && lab.slave().state == state;
}

/// Requests an engagement once, as an operator would, and steps until both sides are engaged or `seconds`
/// have passed.
inline bool engage(Laboratory& lab, double seconds) {
  lab.requests().engage = true;
  for (const double end_s = lab.now_s() + seconds; lab.now_s() < end_s && !both(lab, SafetyState::kEngaged);)
    lab.step();
  return both(lab, SafetyState::kEngaged);
}

}  // namespace longreach::clocks
