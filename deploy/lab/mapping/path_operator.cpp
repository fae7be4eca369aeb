#include "deploy/lab/mapping/path_operator.hpp"

#include <algorithm>
#include <cmath>

namespace longreach {
namespace {

constexpr double kUndershoot = 0.05;  // relative undershoot of an aimed move
constexpr double kTremor_m = 0.0004;  // sd of the end point of an aimed move
// Free parameters of the model:
/// Tolerance of a target: the radius of the tool in the scene; W is twice that.
constexpr double kReached_m = 0.002;
constexpr double kRun_s = 1.0;    // duration of a run in rate mode
constexpr double kRoom_m = 0.06;  // workspace of the handle about home
/// Fraction of the workspace at which a relocation ends, and fraction of its duration in which the hand
/// moves.
constexpr double kStart = 0.8;
constexpr double kAtHome_m = 0.003;  // distance from home at which a released handle counts as home
constexpr double kLive_s = 0.05;     // maximum delay of a live display

}  // namespace

std::string_view to_string(PathStrategy strategy) {
  constexpr std::string_view kNames[] = {"rate", "position", "hybrid"};
  return kNames[static_cast<int>(strategy)];
}

PathPerson PathPerson::draw(Random random) {
  PathPerson p;
  p.reaction_s = 0.25 + 0.04 * random.normal();
  p.aim_s = 0.25 + 0.05 * random.normal();
  p.aim_s_per_bit = 0.07 + 0.015 * random.normal();
  p.spread = 0.11 * std::exp(0.25 * random.normal());
  return p;
}

PathOperator::PathOperator(const PathPerson& person, const PathWork& work, std::vector<PathAim> aims,
                           Random random)
    : person_(person),
      work_(work),
      aims_(std::move(aims)),
      random_(random),
      mode_(work.strategy == PathStrategy::kPosition ? MotionMode::kPosition : MotionMode::kRate) {}

double PathOperator::sd_of(double length_m) const { return person_.spread * length_m + kTremor_m; }

Vector3 PathOperator::error_of(double length_m) {
  const double sd = sd_of(length_m);
  const double x = random_.normal(), y = random_.normal(), z = random_.normal();
  return sd * Vector3(x, y, z);
}

double PathOperator::time_of(double length_m, double width_m) const {
  return person_.aim_s + person_.aim_s_per_bit * std::log2(length_m / std::max(width_m, kTremor_m) + 1.0);
}

double PathOperator::left_m(const Vector3& from_m) const {
  double sum = (aims_[next_].at_m - from_m).norm();
  for (std::size_t i = next_; !aims_[i].target; ++i) sum += (aims_[i + 1].at_m - aims_[i].at_m).norm();
  return sum;
}

double PathOperator::unseen_m(double t_s) const {
  return speed_m_per_s_ * std::clamp(t_s - began_s_, 0.0, work_.late_s);
}

// The minimum leaves the dead zone reliably, by twice the error of the hand at its edge.
double PathOperator::speed_for(double left_m, double approach_m_per_s) const {
  const MappingConfig& m = work_.mapping;
  const double least = 2.0 * m.kv_per_s * sd_of(m.dead_zone_m);
  double most = std::min(m.speed_max_m_per_s, m.kv_per_s * (m.radius_max_m - m.dead_zone_m));
  if (approach_m_per_s > 0.0) most = std::min(most, approach_m_per_s);
  return std::min(std::max(left_m / kRun_s, least), most);
}

void PathOperator::put_hand(double t_s) {
  if (reach_.lasts_s <= 0.0) return;
  const double s = std::clamp((t_s - reach_.begin_s) / reach_.lasts_s, 0.0, 1.0);
  const Vector3 way = reach_.to_m - reach_.from_m;
  hand_m_ = reach_.from_m + s * s * s * (10.0 + s * (6.0 * s - 15.0)) * way;
  hand_m_per_s_ = 30.0 * s * s * (1.0 - s) * (1.0 - s) / reach_.lasts_s * way;
}

PathOperatorOutput PathOperator::step(const PathOperatorInput& in) {
  out_ = {};
  away_ = away_ && in.handle_m.norm() > (live() ? work_.mapping.dead_zone_m : kAtHome_m);
  if (!done()) act(in);
  put_hand(in.t_s);
  out_.requests.mode = mode_;
  out_.target.position_m = hand_m_;
  out_.target.velocity_m_per_s = hand_m_per_s_;
  out_.target.grip = away_ ? Grip::kReleased : work_.grip;
  return out_;
}

void PathOperator::act(const PathOperatorInput& in) {
  switch (phase_) {
    case Phase::kLook:
      if (in.t_s < until_s_) return;
      if (away_ && ran_ && work_.strategy == PathStrategy::kHybrid) take_again(in);
      if (!away_) look(in);
      return;
    case Phase::kMove:
      if (reach_.over(in.t_s)) wait(in, live() && !aims_[next_].target);
      return;
    case Phase::kGlide:
      if (live() || !away_) wait(in, false);
      return;
    case Phase::kRelocate:
      out_.requests.clutch = true;
      if (in.t_s >= until_s_) aim_hand(in);
      return;
    case Phase::kSteer:
      return steer(in);
  }
}

bool PathOperator::live() const { return work_.late_s <= kLive_s; }

void PathOperator::wait(const PathOperatorInput& in, bool foreseen) {
  ++moves_;
  phase_ = Phase::kLook;
  until_s_ = foreseen ? in.t_s : in.t_s + work_.late_s + person_.reaction_s;
}

void PathOperator::leave_behind() {
  if (aims_[next_].target) ran_ = false;
  tried_ = false;
  ++next_;
}

// Continues from a target once it is reached, and from another aim once the operator has moved for it.
void PathOperator::look(const PathOperatorInput& in) {
  const double off_m = (aims_[next_].at_m - in.shown_m).norm();
  if (tried_ && (!aims_[next_].target || off_m <= kReached_m)) leave_behind();
  if (done()) return;
  const bool position =
      work_.strategy == PathStrategy::kPosition || (work_.strategy == PathStrategy::kHybrid && ran_);
  if (position) {
    mode_ = MotionMode::kPosition;
    return aim_hand(in);
  }
  if (mode_ == MotionMode::kRate) return steer_from(in, in.shown_m);
  mode_ = MotionMode::kRate;
  let_go();
}

// Position mode: moves the hand by the displayed error, after a relocation if the workspace does not permit
// it.
void PathOperator::aim_hand(const PathOperatorInput& in) {
  const Vector3 wanted = (aims_[next_].at_m - in.shown_m) / work_.mapping.scale;
  const Vector3 way = clamp_norm(wanted, 2.0 * kStart * kRoom_m);
  if (phase_ != Phase::kRelocate && (hand_m_ + way).norm() > kRoom_m) return relocate(in, way);
  const double length = way.norm();
  tried_ = length >= wanted.norm();
  phase_ = Phase::kMove;
  reach_ = {hand_m_, hand_m_ + (1.0 - kUndershoot) * way + error_of(length), in.t_s,
            time_of(length, 2.0 * kReached_m / work_.mapping.scale)};
}

// Relocates the handle to the position with the most room for the next move. The clutch opens before the hand
// moves and closes afterwards.
void PathOperator::relocate(const PathOperatorInput& in, const Vector3& way_m) {
  ++relocations_;
  phase_ = Phase::kRelocate;
  out_.requests.clutch = true;
  const double lasts_s = random_.uniform(1.0, 1.5);
  until_s_ = in.t_s + lasts_s;
  reach_ = {hand_m_, -kStart * kRoom_m * way_m.normalized(), in.t_s, kStart * lasts_s};
}

// The robot stops, and the handle glides home.
void PathOperator::let_go() {
  away_ = true;
  reach_ = {};
  hand_m_.setZero();
  hand_m_per_s_.setZero();
}

// Position mode continues at the present position of the handle; rate mode starts at home.
void PathOperator::take_again(const PathOperatorInput& in) {
  away_ = false;
  hand_m_ = in.handle_m;
}

// Rate mode: deflects the handle towards the next aim. The speed is that of the whole run.
void PathOperator::steer_from(const PathOperatorInput& in, const Vector3& tool_m) {
  const MappingConfig& m = work_.mapping;
  const Vector3 way = aims_[next_].at_m - tool_m;
  if (way.norm() > 0.0) direction_ = way.normalized();
  const bool begins = phase_ != Phase::kSteer;
  if (begins) {
    speed_m_per_s_ = speed_for(left_m(tool_m), in.approach_m_per_s);
    near_m_ = work_.strategy == PathStrategy::kHybrid ? work_.near_sd * sd_of(left_m(tool_m)) : 0.0;
  }
  const Vector3 hand =
      (1.0 + work_.spring_share) * (m.dead_zone_m + speed_m_per_s_ / m.kv_per_s) * direction_;
  const double length = (hand - hand_m_).norm(), lasts_s = time_of(length, 2.0 * m.dead_zone_m);
  if (begins) began_s_ = in.t_s + 0.5 * lasts_s;
  give_up_s_ = in.t_s + lasts_s + 2.0 * left_m(tool_m) / speed_m_per_s_ + work_.late_s + kRun_s;
  phase_ = Phase::kSteer;
  react_s_.reset();
  reach_ = {hand_m_, hand + error_of(length), in.t_s, lasts_s};
}

void PathOperator::steer(const PathOperatorInput& in) {
  const double beyond = left_m(aims_[next_].at_m);  // the next aim
  const bool last = beyond < near_m_ || aims_[next_].target, hopeless = in.t_s > give_up_s_;
  const double left = direction_.dot(aims_[next_].at_m - in.shown_m) - unseen_m(in.t_s) -
                      (last ? std::max(0.0, near_m_ - beyond) : 0.0);
  if (!react_s_ && (hopeless || left < speed_m_per_s_ * person_.reaction_s))
    react_s_ = in.t_s + person_.reaction_s;
  if (!react_s_ || in.t_s < *react_s_) return;
  if (!last && !hopeless) {
    leave_behind();
    return steer_from(in, in.shown_m + unseen_m(in.t_s) * direction_);
  }
  ran_ = true;
  tried_ = aims_[next_].target && work_.strategy == PathStrategy::kRate;
  let_go();
  phase_ = Phase::kGlide;
}

}  // namespace longreach
