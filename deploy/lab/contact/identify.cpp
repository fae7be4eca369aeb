// Measures how well each estimator identifies a Hunt-Crossley contact, for materials from sponge to steel,
// three exponents, three noise levels and three motions (2 s at 1 kHz, 10 N at the maximum depth). The
// results are compared with the Cramér-Rao bound and with a batch fit of the same records by Ceres Solver.
// The contact law is fixed, so that the configuration of the nodes has no effect.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "deploy/lab/contact/contact_batch.hpp"
#include "deploy/lab/estimators/methods.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

using test::ContactCell;
using test::Excitation;

constexpr int kRecords = 20;
constexpr std::size_t kMethods = std::size(kAllMethods) + 1;  // one more for the batch fit
constexpr double kExponents[] = {1.0, 1.5, 2.0};
constexpr double kNoises[] = {0.01, 0.05, 0.25};
constexpr int kFirstDecade = 2, kLastDecade = 7;
constexpr double kShownN = 1.5, kShownNoise = 0.05;
constexpr const char* kExcitationNames[] = {"probe", "touch", "sine"};

/// Errors of k, of the tangent stiffness at the maximum depth, and of λ, relative to the true values.
using Errors = std::array<double, 3>;

double stiffness_at(double depth, double k, double n) { return k * n * std::pow(depth, n - 1.0); }

Errors errors(const ContactCell& cell, double k, double lambda, double n) {
  const double x = cell.deepest_m();
  return {k / cell.k - 1.0, stiffness_at(x, k, n) / stiffness_at(x, cell.k, cell.n) - 1.0,
          lambda / cell.lambda() - 1.0};
}

Errors online(Method method, const ContactCell& cell, const test::Samples& record) {
  Identifier identifier = by(method, {.exponent = 1.5});
  for (const PenetrationSample& s : record) identifier.step(s, 1e-3);
  const ContactAnswer a = identifier.answer();
  const double n = method == Method::kKelvinVoigt ? 1.0 : a.n.value;
  return a.valid ? errors(cell, a.k.value, a.lambda.value, n) : Errors{1.0, 1.0, 1.0};
}

struct CellResult {
  std::array<Errors, kMethods> rms{};
  Errors bound{};
};

CellResult study(const ContactCell& cell, Random random) {
  CellResult result;
  const test::Samples exact = test::exact_record(cell);
  const test::ContactBound bound = test::cramer_rao(cell, exact);
  result.bound = {bound.k, bound.stiffness, bound.lambda};
  for (int r = 0; r < kRecords; ++r) {
    const test::Samples record = test::with_noise(exact, cell.noise_n, random);
    const test::ContactBatch batch = test::batch_fit(cell, record);
    for (std::size_t m = 0; m < kMethods; ++m) {
      const Errors e = m + 1 == kMethods ? errors(cell, batch.k, batch.lambda, batch.n)
                                         : online(kAllMethods[m], cell, record);
      for (std::size_t p = 0; p < e.size(); ++p) result.rms[m][p] += e[p] * e[p] / kRecords;
    }
  }
  for (Errors& rms : result.rms)
    for (double& value : rms) value = std::sqrt(value);
  return result;
}

std::string metric_name(std::size_t method) {
  std::string name = method + 1 == kMethods ? "batch" : std::string(name_of(kAllMethods[method]));
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

/// Adds the metrics of one motion: the worst error of the stiffness with 0.05 N of noise, and the worst
/// ratios to the batch fit for cells that are identifiable according to the bound.
struct Summary {
  std::array<double, kMethods> stiffness_worst{};
  std::array<Errors, kMethods> ratio_worst{};

  void add(const ContactCell& cell, const CellResult& result) {
    constexpr double kIdentifiable[] = {0.05, 0.05, 0.2};
    for (std::size_t m = 0; m < kMethods && cell.noise_n == kShownNoise; ++m)
      stiffness_worst[m] = std::max(stiffness_worst[m], result.rms[m][1]);
    for (std::size_t p = 0; p < result.bound.size(); ++p) {
      if (result.bound[p] > kIdentifiable[p]) continue;
      for (std::size_t m = 0; m < kMethods; ++m)
        ratio_worst[m][p] = std::max(ratio_worst[m][p], result.rms[m][p] / result.rms.back()[p]);
    }
  }
};

/// Names of the columns in the order of kAllMethods, followed by the batch fit.
constexpr const char* kColumns[kMethods] = {"fixed",      "two_stage",    "log",    "voigt",
                                            "likelihood", "weighted_log", "kalman", "batch"};
constexpr Method kJudgedBesideBatch[] = {Method::kMaximumLikelihood, Method::kExtendedKalman,
                                         Method::kWeightedLogLinear, Method::kTwoStage, Method::kLogLinear};
constexpr const char* kParameters[] = {"k", "stiffness", "lambda"};

std::vector<std::string> columns() {
  std::vector<std::string> names{"k"};
  for (const char* parameter : kParameters) names.push_back(std::string(parameter) + "_bound");
  for (const char* method : kColumns)
    for (const char* parameter : kParameters) names.push_back(std::string(parameter) + "_" + method);
  return names;
}

void write(Trace& trace, const ContactCell& cell, const CellResult& r) {
  std::vector<double> row{cell.k};
  row.insert(row.end(), r.bound.begin(), r.bound.end());
  for (const Errors& rms : r.rms) row.insert(row.end(), rms.begin(), rms.end());
  trace.row(row);
}

}  // namespace

std::vector<Metric> run_identify(const ExperimentRun& run) {
  std::vector<Metric> metrics;
  const Random random = Random(run.seed).child("identify");
  for (std::size_t e = 0; e < std::size(kExcitationNames); ++e) {
    const std::vector<std::string> names = columns();
    Trace trace(run.out, std::string("identify_") + kExcitationNames[e], {names.begin(), names.end()});
    Summary summary;
    for (const double n : kExponents) {
      for (const double noise : kNoises) {
        for (int decade = kFirstDecade; decade <= kLastDecade; ++decade) {
          const ContactCell cell{std::pow(10.0, decade), n, 0.15, noise, static_cast<Excitation>(e)};
          const CellResult result = study(cell, random.child(std::to_string(e * 1000 + decade)));
          summary.add(cell, result);
          if (n == kShownN && noise == kShownNoise) write(trace, cell, result);
        }
        if (run.progress) run.progress((static_cast<double>(e) + (n - 0.5) / 2.0) / 3.0);
      }
    }
    trace.close();
    const std::string way = std::string("_") + kExcitationNames[e];
    for (std::size_t m = 0; m < kMethods; ++m)
      metrics.push_back(
          {"stiffness_error_worst_" + metric_name(m) + way, 100.0 * summary.stiffness_worst[m], "%"});
    // The default estimator of the slave has no name of its own here.
    for (const Method method : kJudgedBesideBatch) {
      const std::size_t m = static_cast<std::size_t>(method);
      const std::string of = method == Method::kMaximumLikelihood ? "" : "_" + metric_name(m);
      for (std::size_t p = 0; p < std::size(kParameters); ++p)
        metrics.push_back(
            {std::string(kParameters[p]) + "_over_batch_worst" + of + way, summary.ratio_worst[m][p], ""});
    }
  }
  return metrics;
}

std::vector<Plot> identify_plots() {
  std::vector<Plot> plots;
  for (const char* way : kExcitationNames) {
    std::vector<Panel> panels;
    for (const auto& [parameter, label] :
         {std::pair{"k_", "error of k (%)"}, std::pair{"stiffness_", "stiffness error (%)"},
          std::pair{"lambda_", "error of λ (%)"}}) {
      const auto curve = [&parameter](const char* of, const char* title, bool points, int mark, int colour) {
        return Curve{std::string(parameter) + of, title, 100.0, points, mark, colour};
      };
      panels.push_back(
          {label,
           {curve("voigt", "Kelvin-Voigt", false, 0, 3), curve("two_stage", "two-stage", false, 0, 4),
            curve("log", "log-linear", false, 0, 1), curve("weighted_log", "weighted log", true, 9, 0),
            curve("kalman", "Kalman filter", true, 11, 3), curve("fixed", "correct fixed n", false, 0, 5),
            curve("likelihood", "maximum likelihood", false, 0, 0),
            curve("batch", "batch fit (Ceres)", true, 6, 2), curve("bound", "Cramér-Rao bound", true, 2, 1)},
           "set logscale xy\nset yrange [1e-2:1e4]\nset format y '%g'\nset ytics 100"});
    }
    plots.push_back({.name = std::string("identify_") + way,
                     .csv = std::string("identify_") + way,
                     .title = std::string("Estimates after 2 s, n = 1.5, noise 0.05 N, motion: ") + way,
                     .x_column = "k",
                     .x_label = "k (N/m^{1.5})",
                     .panels = panels,
                     .panel_px = 240.0});
  }
  return plots;
}

}  // namespace longreach
