#include "deploy/lab/comparison/passivity_law.hpp"

#include <algorithm>

namespace longreach {

ComparisonOutput PassivityLaw::step(const ComparisonInput& in, double dt_s) {
  if (in.report) far_ = *in.report;
  const Vector3& v = in.velocity_m_per_s;
  ComparisonOutput out{.force_n = far_.force_n, .command = {.position_m = in.position_m}};
  const double flow_j = -out.force_n.dot(v) * dt_s;
  (flow_j > 0.0 ? in_j_ : out_j_) += std::abs(flow_j);
  const double missing_j = out_j_ - dissipated_j_ - far_.energy_j;
  const double v2 = v.squaredNorm();
  if (missing_j > 0.0 && v2 > 0.0) {
    const double damping = std::min(missing_j / (dt_s * v2), 2.0 * handle_mass_kg_ / dt_s);
    out.force_n -= damping * v;
    dissipated_j_ += damping * v2 * dt_s;
  }
  out.command.energy_j = in_j_;
  return out;
}

}  // namespace longreach
