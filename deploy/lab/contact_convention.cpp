#include "deploy/lab/contact_convention.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "common/text/number_text.hpp"
#include "deploy/lab/solve/solve_json.hpp"

namespace longreach {

using solve_json::BadRequest;

namespace {

constexpr double kRowsMin = 10.0;

/// The quantile of `values`, which must not be empty.
double quantile_of(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string three_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

double ContactConvention::Sums::correlation() const {
  const double spread = std::sqrt((n * xx - x * x) * (n * ff - f * f));
  return spread > 0.0 ? (n * xf - x * f) / spread : 0.0;
}

void ContactConvention::step(const ContactRow& row, bool time_has_unit) {
  constexpr double kStepMaxS = 0.05;  // a contact cannot be identified below 20 Hz
  if (last_ && rows_ <= kSteps) steps_s_[rows_ - 1] = row.t_s - last_->t_s;
  if (rows_ == kSteps && !time_has_unit) {
    std::ranges::sort(steps_s_);
    const double step = steps_s_[kSteps / 2];
    const char* unit = step < 50.0 ? "ms" : step < 5e4 ? "us" : "ns";
    if (step > kStepMaxS)
      throw BadRequest("\"t\" increases by " + format_number(step) + " per line, so it seems to be in " +
                       unit + "; name the column \"t [" + unit + "]\", or \"t [s]\" if it is in s");
  }
  if (last_ && row.v_m_per_s && last_->v_m_per_s) {
    const double growth = (row.x_m - last_->x_m) / (row.t_s - last_->t_s);
    const double v = 0.5 * (*row.v_m_per_s + *last_->v_m_per_s);
    speeds_.n += 1.0;
    speeds_.vv += v * v;
    speeds_.vg += v * growth;
    speeds_.gg += growth * growth;
  }
  keep(row);
  last_ = row;
  ++rows_;
  Sums& sums = row.x_m > 0.0 ? inside_ : outside_;
  sums.n += 1.0;
  sums.x += row.x_m;
  sums.f += row.f_n;
  sums.xx += row.x_m * row.x_m;
  sums.xf += row.x_m * row.f_n;
  sums.ff += row.f_n * row.f_n;
}

void ContactConvention::keep(const ContactRow& row) {
  if (rows_ % stride_ != 0) return;
  kept_.push_back(row);
  if (kept_.size() < kKeptMax) return;
  for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
  kept_.resize(kept_.size() / 2);
  stride_ *= 2;
}

void ContactConvention::require(bool x_has_unit) const {
  if (rows_ == 0)
    throw BadRequest("there are no samples; write a header such as t,x,f, followed by lines of numbers");
  if (static_cast<double>(kept_.size()) < kRowsMin) return;
  std::vector<double> forces;
  for (const ContactRow& row : kept_) forces.push_back(row.f_n);
  const double free_n = quantile_of(forces, 0.02), force_n = quantile_of(forces, 0.98) - free_n;
  if (!x_has_unit) require_length(free_n, force_n);
  require_speed();
  require_signs();
  require_tare();
  require_surface(free_n, force_n);
}

void ContactConvention::require_length(double free_n, double force_n) const {
  constexpr double kSpanMax_m = 0.2, kSpeedMax_m_per_s = 2.0;
  std::vector<double> depths, speeds;
  for (std::size_t i = 1; i < kept_.size(); ++i) {
    if (kept_[i].f_n - free_n < 0.1 * force_n || !(force_n > 0.0)) continue;
    depths.push_back(kept_[i].x_m);
    speeds.push_back(std::abs((kept_[i].x_m - kept_[i - 1].x_m) / (kept_[i].t_s - kept_[i - 1].t_s)));
  }
  if (static_cast<double>(depths.size()) < kRowsMin) return;
  const double span = quantile_of(depths, 0.98) - quantile_of(depths, 0.02);
  const double speed = quantile_of(speeds, 0.9);
  // Noise alone can also cause high speeds.
  const bool fast = speed > kSpeedMax_m_per_s && span > 0.1 * kSpanMax_m;
  if (span <= kSpanMax_m && !fast) return;
  const std::string unit = span < 1e3 * kSpanMax_m ? "mm" : "um";
  throw BadRequest("\"x\" spans " + three_digits(span) + " m in contact, with speeds of up to " +
                   three_digits(speed) + " m/s, so it seems to be in " + unit + "; name the column \"x [" +
                   unit + "]\", or \"x [m]\" if it is in m");
}

void ContactConvention::require_speed() const {
  constexpr double kSignificant = 5.0, kTimes = 10.0;
  if (speeds_.n < kRowsMin || !(speeds_.vv * speeds_.gg > 0.0)) return;
  const double correlation = speeds_.vg / std::sqrt(speeds_.vv * speeds_.gg);
  if (std::abs(correlation) * std::sqrt(speeds_.n) < kSignificant) return;
  if (correlation < 0.0)
    throw BadRequest("\"v\" is negative where \"x\" increases; change the sign of v, which must be dx/dt");
  const double times = speeds_.vv / speeds_.vg;  // not biased by noise of x
  if (times > kTimes || times < 1.0 / kTimes)
    throw BadRequest("\"v\" is " + three_digits(times) +
                     " times the derivative of \"x\"; state the units, as in \"v [mm/s]\" and \"x [mm]\"");
}

void ContactConvention::require_tare() const {
  constexpr double kShareMax = 0.05;
  std::vector<double> outside, inside;
  for (const ContactRow& row : kept_) (row.x_m > 0.0 ? inside : outside).push_back(row.f_n);
  if (static_cast<double>(std::min(outside.size(), inside.size())) < kRowsMin) return;
  const double free_n = quantile_of(outside, 0.5);
  const double spread_n = quantile_of(outside, 0.9) - quantile_of(outside, 0.1);
  const double contact_n = quantile_of(inside, 0.98) - free_n;
  // If the contact force does not exceed the noise, there is no press.
  if (contact_n < 5.0 * spread_n || std::abs(free_n) < std::max(kShareMax * contact_n, 2.0 * spread_n))
    return;
  throw BadRequest("f is " + three_digits(free_n) + " N in free space (x <= 0); subtract this offset from f");
}

void ContactConvention::require_surface(double free_n, double force_n) const {
  constexpr double kShareMax = 0.6, kForceShare = 0.05, kEarlyShare = 0.1, kCorrelation = 0.5;
  std::vector<double> touching, inside, early;
  for (const ContactRow& row : kept_) {
    if (row.x_m > 0.0) inside.push_back(row.x_m);
    if (row.x_m <= 0.0 && row.f_n - free_n > kEarlyShare * force_n) early.push_back(row.x_m);
    if (row.x_m > 0.0 && row.f_n - free_n > kForceShare * force_n) touching.push_back(row.x_m);
  }
  // A tool that accelerates in free space also causes forces, but they do not grow with x.
  if (static_cast<double>(early.size()) >= kRowsMin && outside_.correlation() > kCorrelation)
    throw BadRequest("the force starts at x = " + three_digits(quantile_of(early, 0.01)) +
                     " m or less; subtract this value from x, which must be 0 at the surface");
  if (static_cast<double>(touching.size()) < kRowsMin) return;
  const double first = quantile_of(touching, 0.01), deepest = quantile_of(inside, 1.0);
  // A recording without a release has no samples at the surface.
  const auto before = std::ranges::count_if(inside, [&](double x) { return x < first; });
  if (first < kShareMax * deepest || static_cast<double>(before) < kRowsMin) return;
  throw BadRequest("the force starts at x = " + three_digits(first) +
                   " m; subtract this value from x, which must be 0 at the surface");
}

void ContactConvention::require_signs() const {
  constexpr double kRows = 10.0, kShare = 0.9, kCorrelation = 0.5;
  const double all = inside_.ff + outside_.ff;
  const double follows = outside_.f < 0.0 ? outside_.correlation() : -outside_.correlation();
  if (outside_.n >= kRows && outside_.ff > kShare * all && follows > kCorrelation) {
    throw BadRequest(
        outside_.f < 0.0
            ? "x and f are negative in contact; change the sign of both"
            : "the force increases where x is negative; change the sign of x, which must be 0 at the "
              "surface and positive inside the material");
  }
  if (inside_.n >= kRows && inside_.ff > kShare * all && inside_.f < 0.0 &&
      inside_.correlation() < -kCorrelation)
    throw BadRequest("f decreases while x increases; change the sign of f");
}

}  // namespace longreach
