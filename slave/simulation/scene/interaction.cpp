#include "slave/simulation/scene/interaction.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kStill_m = 1e-8;  // a way that drowns in the rounding of places, and has no direction

// What has to be added to the mean force so that its work over `way` is `work`.
Vector3 correction(const Vector3& force, const Vector3& way, double work) {
  constexpr double kStill2 = kStill_m * kStill_m;
  const double length2 = way.squaredNorm(), sure = length2 / (length2 * length2 + kStill2 * kStill2);
  return (work - force.dot(way)) * sure * way;
}

// A stretched spring with play: its force, and what it stores.
struct Stretch {
  Vector3 force;
  double energy_j;
  bool beyond;  // the play
};

Stretch stretch(double stiffness, double play, const Vector3& e) {
  const double length = e.norm(), beyond = length - play;
  if (!(beyond > 0.0)) return {Vector3::Zero(), 0.0, false};
  return {-stiffness * beyond / length * e, 0.5 * stiffness * beyond * beyond, true};
}

struct SpringSide {
  double stiffness, damping, play;
};

struct SpringMean {
  Vector3 force = Vector3::Zero();
  double slope = 0.0;
};

SpringMean spring_mean(const SpringSide& s, const Vector3& before, const Vector3& after, const Vector3& way,
                       double dt) {
  const Stretch from = stretch(s.stiffness, s.play, before), to = stretch(s.stiffness, s.play, after);
  if (!from.beyond && !to.beyond) {
    // A bond without play damps also where it is not stretched.
    if (s.play > 0.0) return {};
    return {-s.damping / dt * way, 0.5 * s.stiffness + s.damping / dt};
  }
  Vector3 force = 0.5 * (from.force + to.force);
  force += correction(force, way, from.energy_j - to.energy_j);
  return {force - s.damping / dt * way, 0.5 * s.stiffness + s.damping / dt};
}

Vector3 place(const Pose& X, const Vector3& p) { return X.p + X.q * p; }

Vector3 twisted(const BondRest& rest, const Pose& X_A, const Pose& X_B) {
  return log_rotation(X_B.q * (X_A.q * rest.q_AB).conjugate());
}

SpringSide translation(const BondConfig& b) { return {b.stiffness_n_per_m, b.damping_n_s_per_m, b.play_m}; }
SpringSide rotation(const BondConfig& b) {
  return {b.stiffness_nm_per_rad, b.damping_nm_s_per_rad, b.play_rad};
}

}  // namespace

Interaction touch(const HuntCrossley& law, const SurfacePair& before, const SurfacePair& after,
                  const Mover& a, const Mover& b, double dt) {
  Interaction result;
  const double change = after.depth_m - before.depth_m, damping = 1.0 + law.a * change / dt;
  const auto [elastic, slope] = law.mean_elastic(before.depth_m, change);
  if (!(elastic * damping > 0.0)) return result;
  result.point_m = 0.5 * (before.point_m + after.point_m);
  const Vector3 way = b.way_of(result.point_m) - a.way_of(result.point_m);
  Vector3 along = 0.5 * (before.normal + after.normal);
  // Bounded: a contact may leap from one face to another.
  const Vector3 turned = correction(along, way, -change);
  along += std::min(1.0, 2.0 / std::max(turned.norm(), 1e-300)) * turned;
  result.force_n = elastic * damping * along;
  result.by_way = (slope * damping + elastic * law.a / dt) * along * along.transpose();
  return result;
}

BondRest rest(const Pose& X_A, const Pose& X_B, const Vector3& point_m) {
  return {X_A.q.conjugate() * (point_m - X_A.p), X_B.q.conjugate() * (point_m - X_B.p),
          X_A.q.conjugate() * X_B.q};
}

Interaction hold(const BondConfig& bond, const BondRest& rest, const Mover& a, const Mover& b, double dt) {
  const Vector3 before = place(b.from, rest.on_b_m), after = place(b.to, rest.on_b_m);
  Interaction result;
  result.point_m = 0.5 * (before + after);
  const Vector3 way = b.way_of(result.point_m) - a.way_of(result.point_m);
  const SpringMean linear = spring_mean(translation(bond), before - place(a.from, rest.on_a_m),
                                        after - place(a.to, rest.on_a_m), way, dt);
  const SpringMean angular = spring_mean(rotation(bond), twisted(rest, a.from, b.from),
                                         twisted(rest, a.to, b.to), b.move.turn - a.move.turn, dt);
  result.force_n = linear.force;
  result.moment_nm = angular.force;
  result.by_way.diagonal().setConstant(linear.slope);
  result.by_turn.diagonal().setConstant(angular.slope);
  return result;
}

double energy_j(const BondConfig& bond, const BondRest& rest, const Pose& X_A, const Pose& X_B) {
  const Vector3 e = place(X_B, rest.on_b_m) - place(X_A, rest.on_a_m);
  return stretch(bond.stiffness_n_per_m, bond.play_m, e).energy_j +
         stretch(bond.stiffness_nm_per_rad, bond.play_rad, twisted(rest, X_A, X_B)).energy_j;
}

}  // namespace longreach
