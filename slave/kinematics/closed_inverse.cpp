#include "slave/kinematics/closed_inverse.hpp"

#include <algorithm>
#include <cmath>

#include "common/spatial/sin_cos.hpp"
#include "slave/kinematics/branch_tree.hpp"
#include "slave/kinematics/least_aside.hpp"

namespace longreach {
namespace {

using Role = ArmLoop::Role;
using std::sqrt;

/// One solve: the equations of the loop at one pose, and where solutions go. Lengths in shares of the reach.
class Solving : BranchTree {
 public:
  Solving(const ArmLoop& loop, const Rigid& X_WE, double per_m, const KnownJoints& before, Branches& out,
          bool nearest)
      : BranchTree(loop, before, out, nearest),
        loop_(loop),
        pose_(pose_link(loop, X_WE, per_m)),
        b_(loop.pose_role == Role::kB ? pose_ : loop.link[Role::kB]),
        c_(loop.pose_role == Role::kC ? pose_ : loop.link[Role::kC]),
        f_(loop.pose_role == Role::kF ? pose_ : loop.link[Role::kF]) {}

  void run() {
    spherical_ = loop_.family == ArmFamily::kSpherical;
    spherical_ ? pose_point() : pose_direction();
    loop_.triangular ? solve_triangular() : solve_quartic();
  }

 private:
  // Spherical: T_a L_a x = t with x = Rz(φ_b) y, y = l_b + A_b Rz(φ_c) l_c. Length and z of both sides.
  void pose_point() {
    target_ = -(f_.R.transpose() * f_.p);
    const Trig along = turned_part(b_.R.transpose() * b_.p, c_.p), up = component(2);
    const double squares =
        target_.squaredNorm() - loop_.a_m * loop_.a_m - b_.p.squaredNorm() - c_.p.squaredNorm();
    x_ = {0.5 * squares - along.k, -along.c, -along.s};
    const double ca = loop_.cos_alpha;
    y_ = {target_.z() - ca * up.k, -ca * up.c, -ca * up.s};
  }

  // Parallel: Rz(φ_a)... n_c = n, and the distance along n, both seen from a: u = Rz(-φ_a) n.
  void pose_direction() {
    const Vector3 n_c = c_.R.col(2);
    target_ = f_.R.row(2).transpose();
    const Trig along = turned_part(b_.R.transpose() * b_.p, n_c);
    const Trig across = turned_part(b_.R.row(2).transpose(), n_c);
    x_ = {-f_.p.z() - n_c.dot(c_.p) - along.k, -along.c, -along.s};
    y_ = {loop_.cos_alpha * target_.z() - across.k, -across.c, -across.s};
  }

  void solve_triangular() {
    const bool x_vanishes = loop_.a_m == 0.0;
    const Trig& f = x_vanishes ? x_ : y_;
    const double R = sqrt(f.c * f.c + f.s * f.s);
    if (R <= ClosedInverse::kFree) {
      open(before(Role::kC), std::numbers::pi, std::abs(f.k));
      return;
    }
    const double cos = std::clamp(-f.k / R, -1.0, 1.0);
    const double sin = sqrt(std::max((R - f.k) * (R + f.k), 0.0)) / R;
    const double miss = std::max(std::abs(f.k) - R, 0.0);
    const Turn middle{f.c / R, f.s / R};
    fork(reversed(middle) * before(Role::kC), {cos, sin}, [&](const Turn& aside) {
      const Turn c = middle * aside;
      if (R < kVague) {
        open(c, ClosedInverse::kFree / R, miss);
      } else {
        both_of_plane(c, miss);
      }
    });
  }

  // Rounding leaves φ_c open by ±width: as little aside as what follows needs to reach the pose.
  void open(const Turn& c, double width, double miss) {
    const auto turned_by = [&](double h) {
      const SinCos t = sin_cos(h);
      return c * Turn{t.c, t.s};
    };
    const auto miss_at = [&](double h) { return probe([&] { both_of_plane(turned_by(h), 0.0); }); };
    const bool possible = miss <= loop_.miss_max;
    both_of_plane(possible ? turned_by(least_aside(width, miss_at)) : c, miss);
  }

  void both_of_plane(const Turn& c, double miss) {
    begin(c);
    const bool x_vanishes = loop_.a_m == 0.0;
    const double known = x_vanishes ? at(y_, c) / loop_.sin_alpha : at(x_, c) / loop_.a_m;
    const double square = y_at_.x() * y_at_.x() + y_at_.y() * y_at_.y();
    double r = sqrt(square), side = known;
    if (x_vanishes && !spherical_) {
      // The same direction seen from b: exact where it lies along the axis of b.
      r = sqrt(n_at_.x() * n_at_.x() + n_at_.y() * n_at_.y());
      side = loop_.cos_alpha * known + loop_.sin_alpha * target_.z();
    }
    const double other = sqrt(std::max((r - side) * (r + side), 0.0));
    miss = std::max(miss, std::abs(side) - r);
    const Role role = spherical_ ? Role::kB : Role::kA;
    if (!(std::min(square, known * known + other * other) > kFreeSquare)) return finish(before(role), miss);
    Turn middle = unit(x_vanishes ? Turn{y_at_.y(), y_at_.x()} : Turn{y_at_.x(), -y_at_.y()});
    if (!spherical_) middle = reversed(middle);
    fork(reversed(middle) * before(role), unit({known, other}),
         [&](const Turn& aside) { finish(middle * aside, miss); });
  }

  void solve_quartic() {
    const double a = loop_.a_m, s = loop_.sin_alpha;
    Trig2 F = squared(x_, s * s);
    double size = F.A;
    for (const Trig2& term :
         {squared(y_, a * a), squared(component(0), -a * a * s * s), squared(component(1), -a * a * s * s)}) {
      size += std::abs(term.A);
      F.A += term.A, F.B += term.B, F.C += term.C, F.D += term.D, F.E += term.E;
    }
    const QuarticTurns roots = zeros(F, size);
    for (int i = 0; i < roots.count; ++i) {
      const Turn& c = roots.turn[static_cast<std::size_t>(i)];
      if (too_far(Role::kC, c)) continue;
      begin(c);
      finish(in_plane({at(x_, c) / a, at(y_, c) / s}), 0.0);
    }
  }

  // Of r(c).
  [[nodiscard]] Trig component(int i) const {
    if (!spherical_) return {target_[i], 0.0, 0.0};
    Trig f = turned_part(b_.R.row(i).transpose(), c_.p);
    f.k += b_.p[i];
    return f;
  }

  // All that depends on φ_c alone.
  void begin(const Turn& c) {
    set(Role::kC, c);
    c_turn_ = c;
    origin_ = b_.p + b_.R * turned(c, c_.p);
    y_at_ = spherical_ ? origin_ : target_;
    if (spherical_) return;
    x_axis_ = b_.R * turned(c, c_.R.col(0));
    n_at_ = b_.R * turned(c, c_.R.col(2));
  }

  // (X, Y) = Rot(β) r, as φ_b or φ_a.
  [[nodiscard]] Turn in_plane(const Plane& XY) const {
    return spherical_ ? direction(flat(y_at_), XY, Role::kB) : direction(XY, flat(y_at_), Role::kA);
  }

  void finish(const Turn& turn, double miss) { spherical_ ? wrist(turn, miss) : planar_arm(turn, miss); }

  void wrist(const Turn& b, double miss) {
    const double sin = loop_.sin_alpha, cos = loop_.cos_alpha;
    const Vector3 v = turned(b, y_at_);
    const double x = v.x() + loop_.a_m, y = cos * v.y() - sin * v.z();
    const Turn a = direction({x, y}, flat(target_), Role::kA);
    set(Role::kA, a);
    set(Role::kB, b);
    // Two rows of A_f Rz(φ_a) A_a Rz(φ_b) A_b Rz(φ_c) A_c: columns of what d, e, f have to turn.
    Rows rows;
    rows << f_.R.row(2), f_.R.row(0);
    turn_back(rows, a);
    const Eigen::Vector2d y_column = rows.col(1);
    rows.col(1) = cos * y_column + sin * rows.col(2);
    rows.col(2) = cos * rows.col(2) - sin * y_column;
    turn_back(rows, b);
    rows = Rows(rows * b_.R);
    turn_back(rows, c_turn_);
    rows = Rows(rows * c_.R);
    const Vector3 m = rows.row(0), x_column = rows.row(1);
    const double sd = loop_.first, cd = loop_.first_cos, se = loop_.second, ce = loop_.second_cos;
    const double product = sd * se;
    const double level = m.x() * m.x() + m.y() * m.y();
    const double square = level - cd * cd - ce * ce + 2.0 * cd * ce * m.z();
    miss = std::max(miss, -square);
    const double cos_e = (cd * ce - m.z()) / product, sin_e = sqrt(std::max(square, 0.0)) / std::abs(product);
    const auto place = [&](const Turn& e) {
      const double kx = se * e.s, ky = -cd * se * e.c - sd * ce;
      const Turn d = direction({kx, ky}, flat(m), Role::kD);
      const Vector3 first = turned(d, {e.c, cd * e.s, sd * e.s});
      const Vector3 second = turned(d, {-e.s * ce, cd * e.c * ce - sd * se, sd * e.c * ce + cd * se});
      set(Role::kD, d);
      set(Role::kE, e);
      set(Role::kF, {first.dot(x_column), second.dot(x_column)});
      add(miss);
    };
    const Turn e = unit({cos_e, sin_e});
    if (cd != 0.0 || ce != 0.0 || !all()) return fork(before(Role::kE), e, place);
    place(e);
    add_flipped();
  }

  // Rz(φ_a) (A_a v + l_a), without l_a for a direction.
  [[nodiscard]] Vector3 behind_a(const Turn& a, const Vector3& v, double a_m) const {
    const double sin = loop_.sin_alpha, cos = loop_.cos_alpha;
    return turned(a, {v.x() + a_m, cos * v.y() - sin * v.z(), sin * v.y() + cos * v.z()});
  }

  // Parallel: where d's base is, seen from f.
  [[nodiscard]] Plane base_from_f(const Turn& a, const Vector3& origin) const {
    const Vector3 point = behind_a(a, origin, loop_.a_m);
    return {f_.R.row(0).dot(point) + f_.p.x(), f_.R.row(1).dot(point) + f_.p.y()};
  }

  // A free φ_b turns d's base about a circle: as little from where it was as brings it within the planar
  // arm's reach.
  [[nodiscard]] Turn within_reach(const Turn& a, const Turn& b) const {
    const auto at_turn = [&](double c, double s) {
      return base_from_f(a,
                         {c * origin_.x() - s * origin_.y(), s * origin_.x() + c * origin_.y(), origin_.z()});
    };
    const Plane middle = at_turn(0.0, 0.0), east = at_turn(1.0, 0.0), north = at_turn(0.0, 1.0);
    const Plane ex{east.x - middle.x, east.y - middle.y}, ey{north.x - middle.x, north.y - middle.y};
    const double centre = middle.x * middle.x + middle.y * middle.y + ex.x * ex.x + ex.y * ex.y;
    const Trig square{centre, 2.0 * (middle.x * ex.x + middle.y * ex.y),
                      2.0 * (middle.x * ey.x + middle.y * ey.y)};
    const double least = std::abs(loop_.first) - std::abs(loop_.second),
                 most = std::abs(loop_.first) + std::abs(loop_.second);
    const double now = at(square, b), wanted = std::clamp(now, least * least, most * most);
    const double R = sqrt(square.c * square.c + square.s * square.s);
    if (now == wanted || R <= ClosedInverse::kFree) return b;
    const double cos = std::clamp((wanted - square.k) / R, -1.0, 1.0), sin = sqrt((1.0 - cos) * (1.0 + cos));
    const Turn ahead = Turn{square.c / R, square.s / R} * Turn{cos, sin},
               aside = Turn{square.c / R, square.s / R} * Turn{cos, -sin};
    return likeness(ahead, b) >= likeness(aside, b) ? ahead : aside;
  }

  void planar_arm(const Turn& a, double miss) {
    const double sin = loop_.sin_alpha, cos = loop_.cos_alpha;
    const Vector3 u = turned_back(a, target_);
    const double gx = u.x(), gy = cos * u.y() + sin * u.z();
    Turn b = direction(flat(n_at_), {gx, gy}, Role::kB);
    if (n_at_.x() * n_at_.x() + n_at_.y() * n_at_.y() < kVagueSquare) b = within_reach(a, b);
    set(Role::kA, a);
    set(Role::kB, b);
    const Vector3 axis = behind_a(a, turned(b, x_axis_), 0.0);
    const Turn psi = unit({f_.R.row(0).dot(axis), -f_.R.row(1).dot(axis)});
    const Plane seen = base_from_f(a, turned(b, origin_));
    const Turn Q = psi * Turn{-seen.x, -seen.y};
    const double one = loop_.first, two = loop_.second, sum = one + two, difference = one - two;
    const double distance = sqrt(Q.c * Q.c + Q.s * Q.s), scale = 1.0 / (2.0 * one * two);
    const double minus = (sum - distance) * (sum + distance) * scale;               // 1 - cos φ_e
    const double plus = (distance - difference) * (distance + difference) * scale;  // 1 + cos φ_e
    miss = std::max(miss, -minus * plus);
    const Turn e = unit({0.5 * (plus - minus), sqrt(std::max(minus * plus, 0.0))});
    fork(before(Role::kE), e, [&](const Turn& elbow) {
      const Turn w{one + two * elbow.c, -two * elbow.s};
      const Turn d = direction({w.c, -w.s}, {Q.c, Q.s}, Role::kD);
      set(Role::kD, d);
      set(Role::kE, elbow);
      set(Role::kF, psi * reversed(d * elbow));
      add(miss);
    });
  }

  // A share so short gives its direction to a billionth only,
  static constexpr double kVague = 1e-6;
  // and to a tenth of a millionth.
  static constexpr double kVagueSquare = 1e-18;

  const ArmLoop& loop_;
  const Rigid pose_;
  const Rigid &b_, &c_, &f_;
  bool spherical_ = false;
  Vector3 target_;  // spherical: t; parallel: n
  Trig x_, y_;
  Turn c_turn_;
  Vector3 y_at_, x_axis_, origin_, n_at_;  // y_at_: r(c)
};

}  // namespace

ClosedInverse::ClosedInverse(const Kinematics& arm) : loop_(recognise(arm)), per_m_(1.0 / arm.reach_m()) {
  loop_.a_m *= per_m_;
  for (Rigid& link : loop_.link) link.p *= per_m_;
  loop_.before.p *= per_m_;
  loop_.behind.p *= per_m_;
  if (loop_.family == ArmFamily::kParallel) loop_.first *= per_m_, loop_.second *= per_m_;
}

KnownJoints ClosedInverse::known(const JointVector& joint_rad) const {
  std::array<double, 6> angle;
  for (std::size_t role = 0; role < 6; ++role) {
    const LoopJoint& j = loop_.joint[role];
    angle[role] = j.sign * (joint_rad[j.joint] + j.theta_rad);
  }
  KnownJoints known;
  known.joint_rad = joint_rad;
  const std::array<SinCos, 6> turn = sin_cos(angle);
  for (std::size_t role = 0; role < 6; ++role) known.cos[role] = turn[role].c, known.sin[role] = turn[role].s;
  return known;
}

void ClosedInverse::solve(const Rigid& X_WE, const KnownJoints& before, Branches& out, bool nearest) const {
  Solving(loop_, X_WE, per_m_, before, out, nearest).run();
}

}  // namespace longreach
