#include <cmath>

#include "common/wire/codec.hpp"
#include "common/wire/values.hpp"

namespace longreach {
namespace {

constexpr double kBodyUnitTolerance = 1e-6;  // of a quaternion's norm

bool in_range(double value, double low, double high) {
  return value >= low && value <= high;
}  // false for NaN

/// `p`: x y z, m; `q`: x y z w.
bool read_pose(const float* p, const float* q, Pose& out) {
  out.p = {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  out.q = Quaternion(static_cast<double>(q[3]), static_cast<double>(q[0]), static_cast<double>(q[1]),
                     static_cast<double>(q[2]));
  for (const double x : out.p)
    if (!in_range(x, -kBodyMaxM, kBodyMaxM)) return false;
  if (!in_range(out.q.norm(), 1.0 - kBodyUnitTolerance, 1.0 + kBodyUnitTolerance)) return false;
  out.q.normalize();
  return true;
}

/// The master would reject the poses of all bodies because of one that is impossible.
bool is_sendable(const BodyPose& body) {
  return body.X_WB.p.cwiseAbs().maxCoeff() <= kBodyMaxM && body.X_WB.p.allFinite() &&
         in_range(body.X_WB.q.norm(), 1.0 - 0.5 * kBodyUnitTolerance, 1.0 + 0.5 * kBodyUnitTolerance) &&
         in_range(body.age_s, 0.0, kBodyAgeMaxS);
}

}  // namespace

void write(const BodyPoses& bodies, proto::BodyPoses& out) {
  out.mutable_bodies()->Clear();
  out.mutable_positions_m()->Clear();
  out.mutable_quaternions()->Clear();
  out.mutable_ages_s()->Clear();
  for (std::size_t i = 0; i < kTrackedBodies; ++i) {
    if (!bodies.body[i] || !is_sendable(*bodies.body[i])) continue;
    const BodyPose& body = *bodies.body[i];
    out.add_bodies(static_cast<std::uint32_t>(i + 1));
    for (const double x : body.X_WB.p) out.add_positions_m(static_cast<float>(x));
    for (const double x : body.X_WB.q.coeffs()) out.add_quaternions(static_cast<float>(x));
    out.add_ages_s(static_cast<float>(body.age_s));
  }
}

bool read(const proto::BodyPoses& in, BodyPoses& out) {
  out = {};
  const int count = in.bodies_size();
  if (count > static_cast<int>(kTrackedBodies) || in.positions_m_size() != 3 * count ||
      in.quaternions_size() != 4 * count || in.ages_s_size() != count)
    return false;
  std::uint32_t last = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t number = in.bodies(i);
    if (number <= last || number > kTrackedBodies) return false;
    last = number;
    BodyPose& body = out.body[number - 1].emplace();
    if (!read_pose(in.positions_m().data() + 3 * i, in.quaternions().data() + 4 * i, body.X_WB)) return false;
    body.age_s = static_cast<double>(in.ages_s(i));
    if (!in_range(body.age_s, 0.0, kBodyAgeMaxS)) return false;
  }
  return true;
}

}  // namespace longreach
