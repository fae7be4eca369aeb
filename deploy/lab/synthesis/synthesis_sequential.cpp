#include <algorithm>
#include <nlopt.hpp>

#include "deploy/lab/synthesis/synthesis_search.hpp"

namespace longreach {
namespace {

using Variables = SearchLog::Variables;

constexpr double kStep = 1e-5;       // step of the central differences, in the units of the variables
constexpr double kConverged = 1e-8;  // tolerance for the change of the variables

double goal(unsigned count, const double* /*x*/ x, double* gradient, void* /*log*/) {
  if (gradient) {
    std::fill_n(gradient, count, 0.0);
    gradient[count - 1] = -1.0;
  }
  return -x[count - 1];
}

/// Negative slacks, and their derivatives row by row.
void constraints(unsigned rows, double* result, unsigned columns, const double* at, double* gradient,
                 void* context) {
  auto& log = *static_cast<SearchLog*>(context);
  if (log.left() < kGradientEvaluations) throw nlopt::forced_stop();
  const Variables x = Eigen::Map<const Variables>(at);
  Eigen::Map<Eigen::VectorXd>(result, rows) = -log.evaluate(x).slacks;
  if (!gradient) return;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(gradient, rows,
                                                                                              columns);
  for (unsigned i = 0; i < columns; ++i) {
    Variables up = x, down = x;
    up[i] += kStep;
    down[i] -= kStep;
    jacobian.col(i) = (log.evaluate(down).slacks - log.evaluate(up).slacks) / (2.0 * kStep);
  }
}

}  // namespace

void run_sequential(SearchLog& log, const Variables& start) {
  const Variables low = log.problem().low(), high = log.problem().high();
  nlopt::opt method(nlopt::LD_SLSQP, static_cast<unsigned>(start.size()));
  method.set_lower_bounds({low.begin(), low.end()});
  method.set_upper_bounds({high.begin(), high.end()});
  method.set_min_objective(goal, nullptr);
  method.add_inequality_mconstraint(constraints, &log, std::vector<double>(SynthesisProblem::kSlacks, 1e-9));
  method.set_xtol_abs(kConverged);
  method.set_maxeval(500);
  const Variables inside = start.cwiseMax(low).cwiseMin(high);
  std::vector<double> x(inside.begin(), inside.end());
  double value = 0.0;
  try {
    method.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
    // The budget is spent.
  } catch (const nlopt::roundoff_limited&) {
    // The optimiser cannot improve the design further.
  } catch (const std::runtime_error&) {
    // The optimiser failed. The log has the best design up to then.
  }
}

}  // namespace longreach
