#include <algorithm>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "deploy/lab/synthesis/synthesis_search.hpp"

namespace longreach {
namespace {

constexpr int kPopulation = 40;

/// The problem in the form that pagmo requires: minimisation without constraints. If the objective is the
/// conditioning, its variable is not a gene, because the dimensions determine it.
struct Genes {
  SearchLog* log = nullptr;

  [[nodiscard]] Eigen::Index count() const { return log->problem().aims_at_conditioning() ? 4 : 5; }
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& genes) const {
    SearchLog::Variables x = SearchLog::Variables::Zero();
    std::copy(genes.begin(), genes.end(), x.begin());
    const SynthesisProblem::Evaluation e = log->evaluate(x);
    return {e.violation <= SynthesisProblem::kTolerance ? -e.value : e.violation};
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const SearchLog::Variables low = log->problem().low(), high = log->problem().high();
    return {{low.begin(), low.begin() + count()}, {high.begin(), high.begin() + count()}};
  }
};

}  // namespace

void run_genetic(SearchLog& log, int evaluations, Random random) {
  const auto seed = [&random] { return static_cast<unsigned>(random.next() >> 32U); };
  pagmo::population population(pagmo::problem(Genes{&log}), kPopulation, seed());
  const auto generations = static_cast<unsigned>(std::max(evaluations / kPopulation - 1, 0));
  pagmo::algorithm(
      pagmo::sga(generations, 0.9, 2.0, 0.25, 10.0, 2, "sbx", "polynomial", "tournament", seed()))
      .evolve(population);
}

}  // namespace longreach
