#include "tests/experiments/contact_convention.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/config/number_text.hpp"
#include "tests/experiments/solve_json.hpp"

namespace longreach {

using solve_json::BadRequest;

double ContactConvention::Sums::correlation() const {
  const double spread = std::sqrt((n * xx - x * x) * (n * ff - f * f));
  return spread > 0.0 ? (n * xf - x * f) / spread : 0.0;
}

void ContactConvention::step(const ContactRow& row, bool time_has_unit) {
  constexpr double kStepMaxS = 0.05;  // no contact is identified at less than 20 Hz
  if (rows_ > 0 && rows_ <= kSteps) steps_s_[rows_ - 1] = row.t_s - last_t_s_;
  if (rows_ == kSteps && !time_has_unit) {
    std::ranges::sort(steps_s_);
    const double step = steps_s_[kSteps / 2];
    const char* unit = step < 50.0 ? "ms" : step < 5e4 ? "us" : "ns";
    if (step > kStepMaxS)
      throw BadRequest("\"t\" grows by " + format_number(step) + " a line and is in s, so it looks like " +
                       unit + "; name it \"t [" + unit + "]\", or \"t [s]\" if it is in s");
  }
  last_t_s_ = row.t_s;
  ++rows_;
  Sums& sums = row.x_m > 0.0 ? inside_ : outside_;
  sums.n += 1.0;
  sums.x += row.x_m;
  sums.f += row.f_n;
  sums.xx += row.x_m * row.x_m;
  sums.xf += row.x_m * row.f_n;
  sums.ff += row.f_n * row.f_n;
}

void ContactConvention::require_signs() const {
  constexpr double kRows = 10.0, kShare = 0.9, kCorrelation = 0.5;
  const double all = inside_.ff + outside_.ff;
  const double follows = outside_.f < 0.0 ? outside_.correlation() : -outside_.correlation();
  if (outside_.n >= kRows && outside_.ff > kShare * all && follows > kCorrelation) {
    throw BadRequest(
        outside_.f < 0.0
            ? "the press is counted negative: x and f are below 0 where the force grows; change "
              "the sign of both"
            : "the press is counted negative: the force grows where x is below 0; change the sign "
              "of x, which is 0 at the surface and positive inside");
  }
  if (inside_.n >= kRows && inside_.ff > kShare * all && inside_.f < 0.0 &&
      inside_.correlation() < -kCorrelation)
    throw BadRequest("the press is counted negative: f falls while x grows; change the sign of f");
}

}  // namespace longreach
