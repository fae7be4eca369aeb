#include "slave/simulation/scene/yielding.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <optional>

namespace longreach {
namespace {

constexpr int kMeanIterationsMax = 40;
constexpr int kMeanHalvingsMax = 12;
constexpr double kExactMean = 1e-13;   // of the wrench: converged
constexpr double kRoundedMean = 1e-9;  // likewise, where rounding allows no more

ToolMotion moved(const ToolMotion& free, const Vector6& by) {
  ToolMotion to = free;
  to.q_WE = (exp_rotation(by.head<3>()) * free.q_WE).normalized();
  to.p_WE += by.tail<3>();
  return to;
}

Vector6 move(const ToolMotion& from, const ToolMotion& to) {
  Vector6 by;
  by << log_rotation(to.q_WE * from.q_WE.conjugate()), to.p_WE - from.p_WE;
  return by;
}

// What a wrench gives the tool over its move beyond what the scene would have: not above 0 without creating
// energy.
double excess(const ToolMotion& from, const Yielded& tried, const Vector6& missing) {
  return -missing.dot(move(from, tried.to));
}

}  // namespace

Yielded yield(const Scene& scene, const ToolMotion& from, const ToolMotion& free,
              const Compliance& compliance, double dt) {
  Yielded best{Vector6::Zero(), free, true};
  SceneMean mean = scene.mean_contact(from, free, dt);
  Vector6 missing = mean.wrench;  // what the scene answers, without what was assumed
  if (missing.isZero(0.0)) return best;
  std::optional<Yielded> spare;  // the last one tried that creates no energy
  for (int i = 0; i < kMeanIterationsMax; ++i) {
    if (missing.norm() <= kExactMean * (mean.wrench.norm() + best.wrench.norm())) return best;
    const Vector6 step = (Compliance::Identity() + mean.stiffness * compliance).partialPivLu().solve(missing);
    double share = 1.0;
    bool better = false;
    for (int h = 0; h < kMeanHalvingsMax && !better; ++h, share *= 0.5) {
      Yielded next{best.wrench + share * step, {}, true};
      next.to = moved(free, compliance * next.wrench);
      const SceneMean answer = scene.mean_contact(from, next.to, dt);
      const Vector6 error = answer.wrench - next.wrench;
      better = error.norm() < missing.norm();
      if (excess(from, next, error) <= 0.0) spare = next;
      if (!better) continue;
      best = next;
      mean = answer;
      missing = error;
    }
    if (!better) break;
  }
  best.converged = missing.norm() <= kRoundedMean * (mean.wrench.norm() + best.wrench.norm());
  if (best.converged || excess(from, best, missing) <= 0.0) return best;
  if (spare) return {spare->wrench, spare->to, false};
  // Sharp insides may have no answer that agrees with itself: then the tool is turned round on the spot.
  const Vector6 stop = compliance.completeOrthogonalDecomposition().solve(-move(from, free));
  return {stop, moved(free, compliance * stop), false};
}

}  // namespace longreach
