#pragma once
// The study of the DELTA's dimensional synthesis: which search finds the best design, what it is, and how it
// compares with the catalog's reconstructed device in the same envelope and with the same motors.

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

/// What is asked of the device. The envelope is that of the reconstructed device about its best 60 mm cube;
/// force and torque are assumed: a wall of 4 N in every direction from motors that have 0.3 N m left beside
/// the device's weight.
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

/// One search a seed, for problem A.
std::vector<SearchLog> searches(SearchMethod method, const SynthesisSize& size, std::uint64_t seed,
                                const std::function<void()>& each_done);

/// Values of all searches after so many evaluations, sorted; 0 where nothing feasible was found yet.
std::vector<double> values_after(std::span<const SearchLog> searches, int evaluations);

/// A, then B from its design, then A again from B's with the side that B has reached; not searched, and so
/// infeasible, where B is.
struct Interchange {
  SearchLog a, b, a_again;
};
Interchange interchange(const SearchLog& a, int budget);

/// Problem A for one more side: from `start`, then from random ones while the budget lasts.
SearchLog search_side(double side_m, const SearchLog::Variables& start, std::uint64_t seed, int budget);

/// The best height of a cube in a given device: highest worst conditioning, on a grid of heights of 0.5 mm.
struct CatalogFit {
  double conditioning = 0.0;  // 0: no height meets the demand
  double depth_m = 0.0;
};
CatalogFit best_depth(const DeltaGeometry& g, const DeltaDemand& demand, double side_m);

/// The whole study, with its traces.
std::vector<Metric> synthesise(const ExperimentRun& run, const SynthesisSize& size);

}  // namespace longreach
