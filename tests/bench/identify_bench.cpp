// Cost of a sample of contact identification, over records of 2 s that begin with nothing known. Nanoseconds
// are a reading; the measure is the count of instructions:
//   valgrind --tool=callgrind --toggle-collect='longreach::MaximumLikelihood::step(*' bench_identify
//     --benchmark_filter=MaximumLikelihood --benchmark_min_time=0.01

#include <benchmark/benchmark.h>

#include "deploy/lab/contact/contact_record.hpp"
#include "deploy/lab/estimators/methods.hpp"
#include "slave/estimation/watched_identifier.hpp"

namespace longreach {
namespace {

constexpr std::int64_t kLast = std::size(kAllMethods) - 1;

test::Samples record() {
  Random random(1);
  return test::with_noise(test::exact_record({}), 0.05, random);
}

void MaximumLikelihoodAlone(benchmark::State& state) {
  const test::Samples samples = record();
  for (auto _ : state) {
    MaximumLikelihood estimator(1.0);
    for (const PenetrationSample& s : samples) benchmark::DoNotOptimize(estimator.step(s, 0.0025));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
}
BENCHMARK(MaximumLikelihoodAlone);

/// With noise, hold, change and verdict.
void Identify(benchmark::State& state) {
  const test::Samples samples = record();
  const Method method = kAllMethods[state.range(0)];
  state.SetLabel(std::string(name_of(method)));
  for (auto _ : state) {
    Identifier identifier = by(method);
    for (const PenetrationSample& s : samples) identifier.step(s, 1e-3);
    benchmark::DoNotOptimize(identifier.answer());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
}
BENCHMARK(Identify)->DenseRange(0, kLast);

/// As the slave does it: the surface is not known, and in each tick the answer at the depth where the hand
/// works is asked for.
void SlavesOwnPath(benchmark::State& state) {
  constexpr double kWorking_m = 1e-3;
  const test::Samples samples = record();
  const Method method = kAllMethods[state.range(0)];
  state.SetLabel(std::string(name_of(method)));
  for (auto _ : state) {
    auto identifier = by<WatchedIdentifier>(method, {.force_noise_n = 0.05, .surface_known = false});
    identifier.begin();
    for (const PenetrationSample& s : samples) {
      identifier.step(s, 1e-3);
      benchmark::DoNotOptimize(identifier.answer());
      benchmark::DoNotOptimize(identifier.reported().answer_at(kWorking_m));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.size()));
}
BENCHMARK(SlavesOwnPath)->DenseRange(0, kLast);

}  // namespace
}  // namespace longreach
