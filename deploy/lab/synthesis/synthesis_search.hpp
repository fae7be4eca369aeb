#pragma once
// Searches for the best design of a SynthesisProblem within a budget of evaluations. One evaluation computes
// all margins of one design; evaluations for numerical gradients are counted as well. The search is
// deterministic for a given seed.
//
//   genetic     pagmo's `sga` with simulated binary crossover, polynomial mutation and tournament selection.
//               It is a genetic algorithm proper, unlike NLopt's evolutionary methods, which are evolution
//               strategies. Constraints by Deb's rule (2000): feasible designs rank before infeasible ones,
//               infeasible designs are ranked by violation.
//   sequential  NLopt's SLSQP (Kraft 1988) from one random start until convergence, with gradients by central
//               differences.
//   restarted   sequential, repeated from further random starts until the budget is spent.
//   genetic, then sequential: genetic with four fifths of the budget, then sequential from its best design.
//
// Only `run_genetic` and `run_sequential`, each in its own file, depend on these libraries.

#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/synthesis/synthesis_problem.hpp"

namespace longreach {

/// Counts the evaluations of a search against its budget, and records its progress.
class SearchLog {
 public:
  using Variables = SynthesisProblem::Variables;
  struct Step {
    int evaluations = 0;
    double value = 0.0;  // best feasible value from this evaluation on
  };

  SearchLog(const SynthesisProblem& problem, int budget) : problem_(problem), budget_(budget) {}

  /// Evaluates a design and keeps the best one: feasible designs rank before infeasible ones, feasible
  /// designs are ranked by value, and infeasible designs by violation.
  SynthesisProblem::Evaluation evaluate(const Variables& x);

  [[nodiscard]] const SynthesisProblem& problem() const { return problem_; }
  [[nodiscard]] int left() const { return budget_ - evaluations_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  [[nodiscard]] bool feasible() const { return violation_ <= SynthesisProblem::kTolerance; }
  [[nodiscard]] const Variables& best() const { return best_; }
  [[nodiscard]] double value() const { return feasible() ? value_ : 0.0; }
  [[nodiscard]] double violation() const { return violation_; }
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }

 private:
  SynthesisProblem problem_;
  int budget_;
  int evaluations_ = 0;
  Variables best_ = Variables::Zero();
  double value_ = 0.0;
  double violation_ = 1e300;
  std::vector<Step> steps_;
};

constexpr int kGradientEvaluations = 11;  // evaluations per step of the sequential method

void run_genetic(SearchLog& log, int evaluations, Random random);
/// Runs the sequential method once, until it converges, fails or exhausts the budget.
void run_sequential(SearchLog& log, const SearchLog::Variables& start);

SearchLog::Variables random_start(const SynthesisProblem& problem, Random& random);

enum class SearchMethod : std::uint8_t { kGenetic, kSequential, kRestarted, kGeneticThenSequential };

SearchLog search(SearchMethod method, const SynthesisProblem& problem, std::uint64_t seed, int budget);

}  // namespace longreach
