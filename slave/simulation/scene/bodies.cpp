#include "slave/simulation/scene/bodies.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace longreach {
namespace {

constexpr int kBodyIterationsMax = 30;
constexpr int kBodyHalvingsMax = 8;
constexpr int kSplitsMax = 6;           // of a step that Newton does not solve: 64 parts
constexpr double kExactWrench = 1e-11;  // of the wrenches: converged,
constexpr double kLeast_n = 1e-9;       // and this: what rounding of places makes of stiff bonds
constexpr double kEnoughTimes = 1e3;    // times as much will do where no more is possible

Pose relative(const Pose& start, const Pose& X) {
  return {X.p - start.p, (X.q * start.q.conjugate()).normalized()};
}

// u = [turn; way] of a body to the way of a point at r from its middle.
Eigen::Matrix<double, 3, 6> lever(const Vector3& r) {
  Eigen::Matrix<double, 3, 6> m;
  m << -cross_matrix(r), Matrix3::Identity();
  return m;
}

}  // namespace

Bodies::Bodies(const SceneConfig& scene, const Pose& X_WE_start)
    : model_(scene), gripper_(scene.bodies->gripper), latch_(scene.bodies->latch), X_WE_start_(X_WE_start) {
  for (int i = 0; i < count(); ++i) state_[static_cast<std::size_t>(i)].X = body(i).X_start;
  if (gripper_) fixture_ = model_.site(gripper_->fixture);
  if (latch_) {
    striker_ = model_.geom(latch_->striker);
    keeper_ = model_.geom(latch_->keeper);
    if (model_.body_of(striker_) >= count())
      throw std::invalid_argument("the striker of the latch \"" + latch_->striker +
                                  "\" is not part of a free body");
  }
  near_.reserve(256);
  last_.setZero(6 * count());
  find_near_pairs();
}

const BodiesContact& Bodies::step(const Pose& X_WE, double dt) {
  if (!(dt > 0.0)) return contact_;
  impulse_ = {};
  const Pose X_tool = relative(X_WE_start_, X_WE);
  advance(X_tool, dt, kSplitsMax);
  contact_.F_E_W = {impulse_.moment / dt, impulse_.force / dt};
  close_gripper();
  close_latch();
  contact_.depth_m = 0.0;
  contact_.contacts = 0;
  const int carried = held_ ? held_->body : model_.tool();
  for (const GeomPair& pair : near_) {
    if (!(pair.surface_pair.depth_m > 0.0) || off(pair)) continue;
    ++contact_.contacts;
    const auto ours = [&](int b) { return b == model_.tool() || b == carried; };
    if (ours(pair.body_a) || ours(pair.body_b))
      contact_.depth_m = std::max(contact_.depth_m, pair.surface_pair.depth_m);
  }
  contact_.holds = held_.has_value();
  contact_.latched = latched_.has_value();
  return contact_;
}

// By Newton in the mean wrenches; where that fails, in two steps of half the length.
void Bodies::advance(const Pose& X_tool, double dt, int splits) {
  const Eigen::Index rows = 6 * count();
  Wrenches w = last_;  // it seldom changes much
  attempt(w, X_tool, dt, best_);
  Wrenches missing = best_.answer - w;
  const auto exact = [this] { return kExactWrench * best_.answer.norm() + kLeast_n; };
  bool solved = missing.norm() <= exact();
  for (int i = 0; i < kBodyIterationsMax && !solved; ++i) {
    Stiffness J = Stiffness::Identity(rows, rows);
    for (int b = 0; b < count(); ++b) {
      const auto c = rigid_compliance(body(b).mass, best_.to[static_cast<std::size_t>(b)].X, dt);
      J.middleCols<6>(6 * b) += best_.stiffness.middleCols<6>(6 * b).lazyProduct(c);
    }
    const Wrenches change = J.partialPivLu().solve(missing);
    double share = 1.0;
    bool better = false;
    for (int h = 0; h < kBodyHalvingsMax && !better; ++h, share *= 0.5) {
      const Wrenches tried = w + share * change;
      attempt(tried, X_tool, dt, next_);
      const Wrenches error = next_.answer - tried;
      better = error.norm() < missing.norm();
      if (!better) continue;
      std::swap(best_, next_);
      w = tried;
      missing = error;
    }
    solved = missing.norm() <= (better ? 1.0 : kEnoughTimes) * exact();
    if (!better) break;
  }
  if (solved || splits == 0) {
    if (!solved) ++unconverged_;
    last_ = best_.answer;
    accept(best_, X_tool, dt);
    return;
  }
  const Pose half{0.5 * (X_tool_.p + X_tool.p), X_tool_.q.slerp(0.5, X_tool.q)};
  advance(half, 0.5 * dt, splits - 1);
  advance(X_tool, 0.5 * dt, splits - 1);
}

void Bodies::attempt(const Wrenches& w, const Pose& X_tool, double dt, Attempt& out) {
  for (int i = 0; i < count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const RigidStep step = step_rigid(body(i).mass, state_[k], w.segment<6>(6 * i), dt);
    out.to[k] = step.to;
    out.mover[k] = {state_[k].X, step.to.X, step.move};
  }
  out.mover[static_cast<std::size_t>(model_.tool())] = {X_tool_, X_tool, move_between(X_tool_, X_tool)};
  out.mover[static_cast<std::size_t>(model_.world())] = {};
  answer(dt, out);
}

// What contacts and bonds do over the moves that were tried.
void Bodies::answer(double dt, Attempt& out) {
  const Eigen::Index rows = 6 * count();
  out.answer.setZero(rows);
  out.stiffness.setZero(rows, rows);
  out.on_tool = {};
  out.tool_work_j = 0.0;
  if (!(nearer_m(out) < clear_m_)) find_contacts(dt, out);
  const auto mover = [&](int i) -> const Mover& { return out.mover[static_cast<std::size_t>(i)]; };
  if (held_) {
    const int t = model_.tool();
    add(hold(gripper_->bond, held_->rest, mover(t), mover(held_->body), dt), t, held_->body, out);
  }
  if (latched_) {
    const int a = model_.body_of(keeper_);
    add(hold(latch_->bond, latched_->rest, mover(a), mover(latched_->body), dt), a, latched_->body, out);
  }
}

double Bodies::nearer_m(const Attempt& a) const {
  double most = 0.0;
  for (int i = 0; i <= model_.tool(); ++i) {
    const RigidMove& move = a.mover[static_cast<std::size_t>(i)].move;
    most = std::max(most, move.way_m.norm() + move.turn.norm() * model_.reach_m(i));
  }
  return 2.0 * most;
}

// Contacts, from what was near before to what is near after the moves that were tried.
void Bodies::find_contacts(double dt, Attempt& out) {
  std::array<Pose, kMost> X;
  for (std::size_t i = 0; i < X.size(); ++i) X[i] = out.to[i].X;
  const auto after = model_.near({X.data(), static_cast<std::size_t>(count())},
                                 out.mover[static_cast<std::size_t>(model_.tool())].to);
  const auto mover = [&](int i) -> const Mover& { return out.mover[static_cast<std::size_t>(i)]; };
  // Both lists are in the order of their geoms; a pair that is in one of them alone was, or is, just not
  // near.
  auto before = near_.begin();
  const auto apart = [](const SurfacePair& m) {
    return SurfacePair{-CollisionModel::kNearM, m.point_m, m.normal};
  };
  const auto earlier = [](const GeomPair& a, const GeomPair& b) {
    return a.geom_a != b.geom_a ? a.geom_a < b.geom_a : a.geom_b < b.geom_b;
  };
  const auto find_contacts = [&](const GeomPair& p, const SurfacePair& from, const SurfacePair& to) {
    if (off(p)) return;
    add(touch(model_.law(p), from, to, mover(p.body_a), mover(p.body_b), dt), p.body_a, p.body_b, out);
  };
  for (const GeomPair& pair : after) {
    for (; before != near_.end() && earlier(*before, pair); ++before)
      find_contacts(*before, before->surface_pair, apart(before->surface_pair));
    const bool known = before != near_.end() && !earlier(pair, *before);
    find_contacts(pair, known ? before->surface_pair : apart(pair.surface_pair), pair.surface_pair);
    if (known) ++before;
  }
  for (; before != near_.end(); ++before)
    find_contacts(*before, before->surface_pair, apart(before->surface_pair));
}

void Bodies::add(const Interaction& f, int a, int b, Attempt& out) const {
  if (f.force_n.isZero(0.0) && f.moment_nm.isZero(0.0)) return;
  const std::array<int, 2> who{a, b};
  for (int i = 0; i < 2; ++i) {
    const double sense = i == 0 ? -1.0 : 1.0;
    const Mover& m = out.mover[static_cast<std::size_t>(who[static_cast<std::size_t>(i)])];
    const Vector3 r = f.point_m - m.middle();
    const Vector3 moment = sense * (r.cross(f.force_n) + f.moment_nm), force = sense * f.force_n;
    const int body = who[static_cast<std::size_t>(i)];
    if (body == model_.tool()) {
      out.on_tool.moment += moment;
      out.on_tool.force += force;
      out.tool_work_j -= moment.dot(m.move.turn) + force.dot(m.move.way_m);
    }
    if (body >= count()) continue;
    out.answer.segment<3>(6 * body) += moment;
    out.answer.segment<3>(6 * body + 3) += force;
    const auto mine = lever(r);
    for (int j = 0; j < 2; ++j) {
      const int other = who[static_cast<std::size_t>(j)];
      if (other >= count()) continue;
      const double sign = i == j ? 1.0 : -1.0;
      const auto theirs = lever(f.point_m - out.mover[static_cast<std::size_t>(other)].middle());
      Eigen::Matrix<double, 6, 6> k = sign * mine.transpose() * f.by_way * theirs;
      k.topLeftCorner<3, 3>() += sign * f.by_turn;
      out.stiffness.block<6, 6>(6 * body, 6 * other) += k;
    }
  }
}

void Bodies::accept(const Attempt& done, const Pose& X_tool, double dt) {
  const Mover& tool = done.mover[static_cast<std::size_t>(model_.tool())];
  impulse_.moment += dt * (done.on_tool.moment + (tool.middle() - X_tool.p).cross(done.on_tool.force));
  impulse_.force += dt * done.on_tool.force;
  tool_work_j_ += done.tool_work_j;
  state_ = done.to;
  X_tool_ = X_tool;
  clear_m_ -= nearer_m(done);
  if (clear_m_ < 0.5 * CollisionModel::kNearM) find_near_pairs();
}

void Bodies::find_near_pairs() {
  std::array<Pose, kMost> X;
  for (std::size_t i = 0; i < X.size(); ++i) X[i] = state_[i].X;
  const auto found = model_.near({X.data(), static_cast<std::size_t>(count())}, X_tool_);
  near_.assign(found.begin(), found.end());
  clear_m_ = near_.empty() ? CollisionModel::kNearM : 0.0;
}

bool Bodies::off(const GeomPair& pair) const {
  return latched_ && pair.geom_a == std::min(striker_, keeper_) && pair.geom_b == std::max(striker_, keeper_);
}

Pose Bodies::fixture() const {
  const Pose& X = state_[static_cast<std::size_t>(fixture_.body)].X;
  return {X.p + X.q * fixture_.X_B.p, X.q * fixture_.X_B.q};
}

Vector3 Bodies::to_fixture_m() const { return gripper_ ? Vector3(fixture().p - X_tool_.p) : Vector3::Zero(); }

void Bodies::close_gripper() {
  if (!gripper_ || closed_ == held_.has_value()) return;
  if (!closed_) {
    const Pose& X = state_[static_cast<std::size_t>(held_->body)].X;
    spent_j_ += longreach::energy_j(gripper_->bond, held_->rest, X_tool_, X);
    held_.reset();
    return;
  }
  const Pose X = fixture();
  const double angle = log_rotation(X.q * X_tool_.q.conjugate()).norm();
  if ((X.p - X_tool_.p).norm() > gripper_->reach_m || angle > gripper_->reach_rad) return;
  held_ = {fixture_.body, rest(X_tool_, state_[static_cast<std::size_t>(fixture_.body)].X, X_tool_.p)};
}

void Bodies::close_latch() {
  if (!latch_ || latched_) return;
  const int a = std::min(striker_, keeper_), b = std::max(striker_, keeper_);
  const auto pair =
      std::ranges::find_if(near_, [a, b](const GeomPair& p) { return p.geom_a == a && p.geom_b == b; });
  if (pair == near_.end() || pair->surface_pair.depth_m < latch_->travel_m) return;
  const int body = model_.body_of(striker_), base = model_.body_of(keeper_);
  const Pose& X = state_[static_cast<std::size_t>(body)].X;
  const Quaternion turned = X.q * model_.bodies()[static_cast<std::size_t>(body)].X_start.q.conjugate();
  if (log_rotation(model_.geom_pose(keeper_).q.conjugate() * turned).norm() > latch_->angle_rad) return;
  spent_j_ += model_.law(*pair).energy_j(pair->surface_pair.depth_m);
  const Pose X_base = base < count() ? state_[static_cast<std::size_t>(base)].X : Pose{};
  latched_ = {body, rest(X_base, X, X.p)};
}

Pose Bodies::pose(int i) const {
  const Pose X_SB = state(i).X * inverse(body(i).X_BI);
  return {X_WE_start_.p + X_SB.p, X_SB.q.normalized()};
}

void Bodies::push(int i, const Vector3& v_m_per_s, const Vector3& w_rad_per_s) {
  RigidState& s = state_[static_cast<std::size_t>(i)];
  s.v_m_per_s = v_m_per_s;
  s.spin_kg_m2_per_s = s.X.q * body(i).mass.inertia_kg_m2.cwiseProduct(s.X.q.conjugate() * w_rad_per_s);
}

void Bodies::place(int i, const Pose& X_S) {
  state_[static_cast<std::size_t>(i)].X = X_S;
  find_near_pairs();
}

double Bodies::energy_j() const {
  double sum = 0.0;
  for (int i = 0; i < count(); ++i) sum += longreach::energy_j(body(i).mass, state(i));
  for (const GeomPair& pair : near_) {
    if (!off(pair)) sum += model_.law(pair).energy_j(pair.surface_pair.depth_m);
  }
  const auto X = [this](int i) { return i < count() ? state(i).X : i == model_.tool() ? X_tool_ : Pose{}; };
  if (held_) sum += longreach::energy_j(gripper_->bond, held_->rest, X_tool_, X(held_->body));
  if (latched_)
    sum += longreach::energy_j(latch_->bond, latched_->rest, X(model_.body_of(keeper_)), X(latched_->body));
  return sum;
}

}  // namespace longreach
