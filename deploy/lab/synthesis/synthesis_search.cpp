#include "deploy/lab/synthesis/synthesis_search.hpp"

namespace longreach {

SynthesisProblem::Evaluation SearchLog::evaluate(const Variables& x) {
  const SynthesisProblem::Evaluation e = problem_.evaluate(x);
  ++evaluations_;
  const bool now_feasible = e.violation <= SynthesisProblem::kTolerance;
  const bool better =
      feasible() ? now_feasible && e.value > value_ : now_feasible || e.violation < violation_;
  if (better) {
    best_ = x;
    value_ = e.value;
    violation_ = e.violation;
    if (now_feasible) steps_.push_back({evaluations_, value_});
  }
  return e;
}

SearchLog::Variables random_start(const SynthesisProblem& problem, Random& random) {
  SearchLog::Variables x;
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = random.uniform(problem.low()[i], problem.high()[i]);
  return x;
}

SearchLog search(SearchMethod method, const SynthesisProblem& problem, std::uint64_t seed, int budget) {
  SearchLog log(problem, budget);
  const Random random(seed);
  Random starts = random.child("starts");
  switch (method) {
    case SearchMethod::kGenetic:
      run_genetic(log, budget, random.child("genetic"));
      break;
    case SearchMethod::kSequential:
      run_sequential(log, random_start(problem, starts));
      break;
    case SearchMethod::kRestarted:
      while (log.left() >= kGradientEvaluations) run_sequential(log, random_start(problem, starts));
      break;
    case SearchMethod::kGeneticThenSequential: {
      run_genetic(log, budget / 5 * 4, random.child("genetic"));
      SearchLog::Variables start = log.best();
      if (problem.aims_at_conditioning()) start[4] = log.value();
      run_sequential(log, start);
      break;
    }
  }
  return log;
}

}  // namespace longreach
