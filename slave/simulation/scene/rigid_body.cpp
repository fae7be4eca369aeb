#include "slave/simulation/scene/rigid_body.hpp"

#include <Eigen/LU>

namespace longreach {
namespace {

constexpr int kTurnIterationsMax = 12;
constexpr double kExactTurn = 1e-15;

// dt Ω̄ in the body, by Newton on 2 I (Ω̄ - Ω) + dt Ω̄ × (I Ω̄ + dt T/2) - dt T = 0, T the moment in the body.
Vector3 mean_turn(const Vector3& inertia, const Vector3& w, const Vector3& T, double dt) {
  Vector3 mean = w + 0.5 * dt * T.cwiseQuotient(inertia);
  for (int i = 0; i < kTurnIterationsMax; ++i) {
    const Vector3 h = inertia.cwiseProduct(mean) + 0.5 * dt * T;
    const Vector3 error = 2.0 * inertia.cwiseProduct(mean - w) + dt * (mean.cross(h) - T);
    Matrix3 slope = dt * (cross_matrix(mean) * inertia.asDiagonal() - cross_matrix(h));
    slope.diagonal() += 2.0 * inertia;
    const Vector3 change = slope.inverse() * error;
    mean -= change;
    if (!(change.norm() > kExactTurn * mean.norm())) break;
  }
  return dt * mean;
}

}  // namespace

RigidStep step_rigid(const RigidMass& mass, const RigidState& from, const Vector6& wrench, double dt) {
  RigidStep step{from, {}};
  const Vector3 moment = wrench.head<3>(), force = wrench.tail<3>();
  const Vector3 dv = dt * (force / mass.mass_kg + mass.gravity_m_per_s2);
  step.move.way_m = dt * (from.v_m_per_s + 0.5 * dv);
  step.to.X.p += step.move.way_m;
  step.to.v_m_per_s += dv;
  step.to.spin_kg_m2_per_s += dt * moment;
  const Quaternion back = from.X.q.conjugate();
  const Vector3 w = (back * from.spin_kg_m2_per_s).cwiseQuotient(mass.inertia_kg_m2);
  const Vector3 turn = mean_turn(mass.inertia_kg_m2, w, back * moment, dt);
  step.move.turn = from.X.q * turn;
  step.to.X.q = from.X.q * Quaternion(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z());
  step.to.X.q.normalize();
  return step;
}

RigidMove move_between(const Pose& from, const Pose& to) {
  const Quaternion q = to.q * from.q.conjugate();
  return {2.0 / q.w() * q.vec(), to.p - from.p};
}

Eigen::Matrix<double, 6, 6> rigid_compliance(const RigidMass& mass, const Pose& X, double dt) {
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  const Matrix3 R = X.q.toRotationMatrix();
  const double half = 0.5 * dt * dt;
  c.topLeftCorner<3, 3>() = half * R * mass.inertia_kg_m2.cwiseInverse().asDiagonal() * R.transpose();
  c.bottomRightCorner<3, 3>().diagonal().setConstant(half / mass.mass_kg);
  return c;
}

Vector3 angular_rad_per_s(const RigidMass& mass, const RigidState& state) {
  const Vector3 body = (state.X.q.conjugate() * state.spin_kg_m2_per_s).cwiseQuotient(mass.inertia_kg_m2);
  return state.X.q * body;
}

double energy_j(const RigidMass& mass, const RigidState& state) {
  const double turning = 0.5 * state.spin_kg_m2_per_s.dot(angular_rad_per_s(mass, state));
  const Vector3& v = state.v_m_per_s;
  return turning + mass.mass_kg * (0.5 * v.squaredNorm() - mass.gravity_m_per_s2.dot(state.X.p));
}

}  // namespace longreach
