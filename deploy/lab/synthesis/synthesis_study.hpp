#pragma once
// Study of the dimensional synthesis of a DELTA: the best search, the best design, and a comparison with the
// reconstructed device of the catalog in the same envelope and with the same motors.

#include <span>
#include <string_view>
#include <vector>

#include "deploy/lab/experiment.hpp"
#include "deploy/lab/synthesis/synthesis_search.hpp"

namespace longreach {

struct SynthesisSize {
  int seeds = 20;
  int budget = 3000;  // evaluations of one search
};

/// Requirements of the device. The envelope is that of the reconstructed device about its best 60 mm cube;
/// force and torque are assumptions: a wall of 4 N in every direction with motors that have 0.3 N m left
/// besides the weight of the device.
DeltaDemand synthesis_demand();
constexpr double kSynthesisSide_m = 0.06;        // of the cube in problem A
constexpr double kSynthesisConditioning = 0.45;  // in problem B

struct MethodName {
  SearchMethod method;
  std::string_view name;
};
inline constexpr MethodName kMethods[] = {{SearchMethod::kGenetic, "genetic"},
                                          {SearchMethod::kSequential, "sequential"},
                                          {SearchMethod::kRestarted, "restarted"},
                                          {SearchMethod::kGeneticThenSequential, "genetic_sequential"}};

/// One search per seed, for problem A.
std::vector<SearchLog> searches(SearchMethod method, const SynthesisSize& size, std::uint64_t seed,
                                const std::function<void()>& each_done);

/// Values of all searches after this number of evaluations, sorted; 0 while there is no feasible design.
std::vector<double> values_after(std::span<const SearchLog> searches, int evaluations);

/// A, then B from its design, then A again from the design of B with its side; if B is infeasible, the last
/// step is skipped and infeasible.
struct Interchange {
  SearchLog a, b, a_again;
};
Interchange interchange(const SearchLog& a, int budget);

/// Problem A for another side: from `start`, then from random starts while the budget lasts.
SearchLog search_side(double side_m, const SearchLog::Variables& start, std::uint64_t seed, int budget);

/// The best height of a cube in a given device: maximum worst conditioning, on a grid of 0.5 mm.
struct CatalogFit {
  double conditioning = 0.0;  // 0: no height fulfils the requirements
  double depth_m = 0.0;
};
CatalogFit best_depth(const DeltaGeometry& g, const DeltaDemand& demand, double side_m);

/// The whole study, with its traces.
std::vector<Metric> synthesise(const ExperimentRun& run, const SynthesisSize& size);

}  // namespace longreach
