#include "deploy/lab/synthesis/synthesis_study.hpp"

#include <algorithm>

namespace longreach {
namespace {

SynthesisProblem problem_a(double side_m) {
  return {SynthesisGoal::kConditioning, synthesis_demand(), side_m};
}

SynthesisProblem problem_b() {
  DeltaDemand demand = synthesis_demand();
  demand.conditioning = kSynthesisConditioning;
  return {SynthesisGoal::kSide, demand, 0.0};
}

}  // namespace

DeltaDemand synthesis_demand() {
  DeltaDemand demand;
  demand.force_n = 4.0;
  demand.torque_nm = 0.3;
  demand.radius_m = 0.108;
  demand.height_m = 0.150;
  return demand;
}

std::vector<SearchLog> searches(SearchMethod method, const SynthesisSize& size, std::uint64_t seed,
                                const std::function<void()>& each_done) {
  std::vector<SearchLog> logs;
  Random seeds = Random(seed).child("synthesis");  // the same for all methods
  for (int i = 0; i < size.seeds; ++i) {
    logs.push_back(search(method, problem_a(kSynthesisSide_m), seeds.next(), size.budget));
    if (each_done) each_done();
  }
  return logs;
}

std::vector<double> values_after(std::span<const SearchLog> searches, int evaluations) {
  std::vector<double> values;
  for (const SearchLog& log : searches) {
    double value = 0.0;
    for (const SearchLog::Step& step : log.steps()) {
      if (step.evaluations <= evaluations) value = step.value;
    }
    values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

Interchange interchange(const SearchLog& a, int budget) {
  SearchLog b(problem_b(), budget);
  run_sequential(b, b.problem().variables(a.problem().dimensions(a.best()), a.value()));
  SearchLog a_again(problem_a(b.value()), budget);
  if (!b.feasible()) return {a, b, a_again};
  run_sequential(a_again,
                 a_again.problem().variables(b.problem().dimensions(b.best()), kSynthesisConditioning));
  return {a, b, a_again};
}

SearchLog search_side(double side_m, const SearchLog::Variables& start, std::uint64_t seed, int budget) {
  SearchLog log(problem_a(side_m), budget);
  Random random = Random(seed).child("front");
  run_sequential(log, start);
  while (log.left() >= kGradientEvaluations) run_sequential(log, random_start(log.problem(), random));
  return log;
}

CatalogFit best_depth(const DeltaGeometry& g, const DeltaDemand& demand, double side_m) {
  constexpr double kStep_m = 5e-4;
  CatalogFit best;
  for (double depth_m = kStep_m; depth_m < g.size_m(); depth_m += kStep_m) {
    const DeltaCubeFigures f = figures(g, demand, {{0.0, 0.0, g.up() * depth_m}, side_m}, 5);
    if (f.slack >= 0.0 && f.conditioning > best.conditioning) best = {f.conditioning, depth_m};
  }
  return best;
}

}  // namespace longreach
