#pragma once
// Study of the dimensional synthesis of a DELTA device: which search method is best, which design is best,
// and how that design compares with the reconstructed device of the catalog, which has the same envelope and
// motors.

#include <span>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/synthesis/synthesis_search.hpp"

namespace longreach {

struct SynthesisSize {
  int seeds = 20;
  int budget = 3000;  // evaluations per search
};

/// Returns the requirements. The envelope is that of the reconstructed device for its best 60 mm cube. Force
/// and torque are assumptions: 4 N in every direction, and 0.3 N m per motor in addition to the torque that
/// supports the weight of the device.
DeltaDemand synthesis_demand();
constexpr double kSynthesisSide_m = 0.06;        // side of the cube in problem A
constexpr double kSynthesisConditioning = 0.45;  // required conditioning in problem B

struct MethodName {
  SearchMethod method;
  std::string_view name;
};
inline constexpr MethodName kMethods[] = {{SearchMethod::kGenetic, "genetic"},
                                          {SearchMethod::kSequential, "sequential"},
                                          {SearchMethod::kRestarted, "restarted"},
                                          {SearchMethod::kGeneticThenSequential, "genetic_sequential"}};

/// Runs one search of problem A per seed.
std::vector<SearchLog> searches(SearchMethod method, const SynthesisSize& size, std::uint64_t seed,
                                const std::function<void()>& each_done);

/// Returns the values of all searches after this number of evaluations, sorted. The value is 0 for a search
/// that has not found a feasible design.
std::vector<double> values_after(std::span<const SearchLog> searches, int evaluations);

/// Interchange of objective and constraint: problem A, then problem B starting from the design of A, then
/// problem A again starting from the design and the cube side of B. If B is infeasible, the last search is
/// not run and counts as infeasible.
struct Interchange {
  SearchLog a, b, a_again;
};
Interchange interchange(const SearchLog& a, int budget);

/// Solves problem A for another side of the cube, from `start` and then from random starts until the budget
/// is spent.
SearchLog search_side(double side_m, const SearchLog::Variables& start, std::uint64_t seed, int budget);

/// The depth of a cube in a given device at which the worst-case conditioning is best, on a grid of 0.5 mm.
struct CatalogFit {
  double conditioning = 0.0;  // worst conditioning; 0: no depth fulfils the requirements
  double depth_m = 0.0;
};
CatalogFit best_depth(const DeltaGeometry& g, const DeltaDemand& demand, double side_m);

/// Runs the whole study and writes its traces.
std::vector<Metric> synthesise(const ExperimentRun& run, const SynthesisSize& size);

}  // namespace longreach
