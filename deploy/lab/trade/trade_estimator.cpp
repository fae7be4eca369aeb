// The error of each estimator after 2 s of a contact at 1 kHz (k 1e4 N/m^1.5, λ/k 0.15 s/m, noise 0.05 N)
// against its cost per sample. FIXED_EXPONENT is run with the true exponent and, with an unknown surface,
// with the exponent 1. The default is MAXIMUM_LIKELIHOOD with an unknown surface; all others know the
// surface. A batch fit by Ceres Solver is included for comparison.

#include <cmath>

#include "deploy/lab/contact/contact_batch.hpp"
#include "deploy/lab/estimators/methods.hpp"
#include "deploy/lab/trade/cost.hpp"
#include "deploy/lab/trade/trade.hpp"

namespace longreach {
namespace {

constexpr int kRecords = 200;  // errors within 5 %
constexpr int kSamples = 128;  // samples: what is done every 32 or 128 is in them

struct Way {
  const char* name;
  Method method;
  IdentifierConfig config{};
  bool standard = false;
};

const Way kWays[] = {
    {"fixed_exponent", Method::kFixedExponent, {.exponent = 1.5}},
    {"fixed_exponent_1", Method::kFixedExponent, {.exponent = 1.0, .surface_known = false}},
    {"two_stage", Method::kTwoStage},
    {"log_linear", Method::kLogLinear},
    {"weighted_log_linear", Method::kWeightedLogLinear},
    {"extended_kalman", Method::kExtendedKalman},
    {"kelvin_voigt", Method::kKelvinVoigt},
    {"maximum_likelihood", Method::kMaximumLikelihood},
    {"unknown_surface", Method::kMaximumLikelihood, {.surface_known = false}, true},
};

double tangent(double k, double n, double x) { return k * n * std::pow(x, n - 1.0); }

TradePoint of_way(const Way& way, const test::ContactCell& cell, const std::vector<test::Samples>& records) {
  TradePoint point{way.name, ""};
  point.standard = way.standard;
  // The working point: the depth at half of the force.
  const double x = std::pow(5.0 / cell.k, 1.0 / cell.n), right = tangent(cell.k, cell.n, x);
  for (const test::Samples& record : records) {
    Identifier identifier = by(way.method, way.config);
    for (const PenetrationSample& s : record) identifier.step(s, 1e-3);
    if (!identifier.answer().valid) {
      point.error += 1.0 / kRecords;
      continue;
    }
    const double error =
        identifier.answer_at(way.config.surface_known ? x : identifier.depth_of(5.0)).stiffness.value /
            right -
        1.0;
    point.error += error * error / kRecords;
  }
  point.error = 100.0 * std::sqrt(point.error);
  const test::Samples& record = records.front();
  Identifier identifier = by(way.method, way.config);
  const auto step = [&](int i) {
    identifier.step(record[static_cast<std::size_t>(i) % record.size()], 1e-3);
  };
  point.cost = cost_ns(static_cast<int>(record.size()), step);
  point.instructions = instructions(kSamples, step);
  return point;
}

std::vector<TradePoint> measure_estimator(const ExperimentRun& run) {
  const test::ContactCell cell;
  const test::Samples exact = test::exact_record(cell);
  Random random = Random(run.seed).child("trade estimator");
  std::vector<test::Samples> records;
  for (int i = 0; i < kRecords; ++i) records.push_back(test::with_noise(exact, cell.noise_n, random));
  std::vector<TradePoint> points;
  for (const Way& way : kWays) points.push_back(of_way(way, cell, records));

  TradePoint batch{"batch_fit", ""};
  const double x = std::pow(5.0 / cell.k, 1.0 / cell.n), right = tangent(cell.k, cell.n, x);
  for (const test::Samples& record : records) {
    const test::ContactBatch fit = test::batch_fit(cell, record);
    const double error = tangent(fit.k, fit.n, x) / right - 1.0;
    batch.error += error * error / kRecords;
  }
  batch.error = 100.0 * std::sqrt(batch.error);
  batch.cost = cost_ns(3, [&](int i) { test::batch_fit(cell, records[static_cast<std::size_t>(i)]); }) /
               static_cast<double>(exact.size());
  points.push_back(batch);
  return points;
}

}  // namespace

TradeStage trade_estimator() {
  return {.name = "estimator",
          .title = "Estimated stiffness of a contact (n = 1.5) after 2 s",
          .cost = "computing time per sample",
          .cost_unit = "ns",
          .error = "stiffness error at 5 N",
          .error_unit = "%",
          .series = {"fixed_exponent", "fixed_exponent_1", "two_stage", "log_linear", "weighted_log_linear",
                     "extended_kalman", "kelvin_voigt", "maximum_likelihood", "unknown_surface", "batch_fit"},
          .measure = measure_estimator};
}

}  // namespace longreach
