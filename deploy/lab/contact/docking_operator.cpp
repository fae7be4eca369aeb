#include "deploy/lab/contact/docking_operator.hpp"

#include <algorithm>

namespace longreach {
namespace {

constexpr double kFirm_n_per_m = 400.0;  // a firm grip
constexpr double kPullMax_m = 0.04;      // maximum lead of the hand's target over the handle: 16 N
constexpr double kRoom_m = 0.055;        // range of the handle about home, beyond which it is relocated
constexpr double kRelocation_s = 1.2;
constexpr double kHand_m_per_s = 0.15;  // of the hand that moves the handle and not the robot
constexpr double kThere_m = 0.006;      // from the goal, in rate mode
constexpr double kSlowHand_m_per_s = 0.01, kFastHand_m_per_s = 0.03;  // of hands, of the tool
constexpr double kInsert_m_per_s = 0.01, kPress_m_per_s = 0.0015;
constexpr double kBetweenRests_s = 15.0, kLongestRest_s = 3.0;
constexpr double kStandoff_m = 0.06;             // in front of the fixture, before the grasp
constexpr double kCareful_m = 0.03;              // in front of the catch
constexpr double kFelt_n = 3.0, kGone_n = 1.25;  // at the tool; the hand feels the fraction ke of it
constexpr double kBeside_m = 0.155;              // distance of the rim of the funnel from its centre
constexpr double kTilt_rad = 0.15;               // more than the channel permits

}  // namespace

std::string_view to_string(DockingMistake mistake) {
  constexpr std::string_view kNames[] = {"none", "tilted", "misses_guide", "pushes_on"};
  return kNames[static_cast<int>(mistake)];
}

DockingOperator::DockingOperator(const MappingConfig& mapping, const RenderingConfig& rendering,
                                 const DockingGuide& guide, DockingMistake mistake, Random random)
    : mapping_(mapping),
      rate_stiffness_(rendering.rate_stiffness_n_per_m),
      ke_(rendering.ke),
      guide_(guide),
      mistake_(mistake) {
  const auto error = [&random](double sd) {
    return Vector3(sd * random.normal(), sd * random.normal(), sd * random.normal());
  };
  misjudged_m_ = error(0.002);
  misjudged_rad_ = error(0.006);
  reaction_s_ = std::max(0.15, 0.25 + 0.04 * random.normal());
  speed_m_per_s_ = random.uniform(kSlowHand_m_per_s, kFastHand_m_per_s);
  random_ = random.child("rests");
}

// The hand pauses at times. In rate mode it returns to the centre first.
bool DockingOperator::rests(const DockingOperatorInput& in) {
  if (relocating_s_ || phase_ == DockingPhase::kWait) return false;
  if (in.t_s > rest_ends_s_) {
    const bool begins = random_.chance(in.dt_s / kBetweenRests_s);
    if (begins) rest_ends_s_ = in.t_s + random_.uniform(0.5, kLongestRest_s);
    return false;
  }
  if (mode_ == MotionMode::kRate) hand_m_ += clamp_norm(centre_m_ - hand_m_, kHand_m_per_s * in.dt_s);
  there_s_.reset();
  return true;
}

void DockingOperator::enter(DockingPhase phase, const DockingOperatorInput& in) {
  phase_ = phase;
  entered_s_ = in.t_s;
  there_s_.reset();
  look_s_.reset();
  rounds_ = 0;
}

void DockingOperator::choose(const DockingOperatorInput& in, MotionMode mode) {
  if (mode == mode_) return;
  mode_ = mode;
  out_.requests.mode = mode;
  hand_m_ = in.master->p_MH;
  centre_m_ = mapping_.rate_centre == RateCentre::kHandleOrigin ? Vector3::Zero() : hand_m_;
}

bool DockingOperator::looked(const DockingOperatorInput& in) {
  if (!look_s_) look_s_ = in.t_s;
  return in.t_s - *look_s_ > in.rtt_s + reaction_s_ + 0.8;
}

// Rate mode: deflects the handle towards the target, and returns it to the centre once the ghost is there.
bool DockingOperator::drive(const DockingOperatorInput& in, const Vector3& target_m, double speed) {
  choose(in, MotionMode::kRate);
  const Vector3 error = target_m - in.ghost_m;
  const double distance = error.norm();
  Vector3 to_m = centre_m_;
  if (distance >= kThere_m) {
    const double v = std::clamp(distance / 1.5, 0.004, speed);
    const double spring = (in.master->far.gripper.holds ? 1.5 : 1.0) * rate_stiffness_;
    to_m +=
        (mapping_.dead_zone_m + v / mapping_.kv_per_s) * (1.0 + spring / kFirm_n_per_m) / distance * error;
  }
  hand_m_ += clamp_norm(to_m - hand_m_, kHand_m_per_s * in.dt_s);
  return distance < kThere_m;
}

// Position mode: moves the hand until the ghost is at the target, and relocates the handle at the end of its
// range.
bool DockingOperator::carry(const DockingOperatorInput& in, const Vector3& target_m, double speed) {
  choose(in, MotionMode::kPosition);
  const Vector3 error = target_m - in.ghost_m;
  if (relocating_s_ || (hand_m_.norm() > kRoom_m && error.norm() > 0.004)) {
    if (!relocating_s_) relocate_to_ = -0.9 * kRoom_m * error.normalized();
    relocate(in, *relocate_to_);
    return false;
  }
  hand_m_ += in.dt_s / in.master->scale * clamp_norm(error / 0.8, speed);
  hand_m_ = in.master->p_MH + clamp_norm(hand_m_ - in.master->p_MH, kPullMax_m);
  if (error.norm() > 0.001) {
    there_s_.reset();
    return false;
  }
  if (!there_s_) there_s_ = in.t_s;
  return in.t_s - *there_s_ > 0.3;
}

bool DockingOperator::relocate(const DockingOperatorInput& in, const Vector3& to_m) {
  if (!relocating_s_) relocating_s_ = in.t_s;
  const double t = in.t_s - *relocating_s_;
  out_.requests.clutch = true;
  if (t > 0.1) hand_m_ += clamp_norm(to_m - hand_m_, kHand_m_per_s * in.dt_s);
  const bool there = (to_m - in.master->p_MH).norm() < 0.004;
  if (t < kRelocation_s || (!there && t < 2.0 * kRelocation_s)) return false;  // a contact may push
  hand_m_ = in.master->p_MH;
  relocating_s_.reset();
  return true;
}

void DockingOperator::turn(const DockingOperatorInput& in, const Vector3& target_rad) {
  if (relocating_s_) return;
  const Vector3 error = target_rad - in.ghost_rad;
  hand_rad_ += in.dt_s / in.master->scale * clamp_norm(error / 1.0, 0.03);
  hand_rad_ = clamp_norm(hand_rad_, 0.6);
}

Vector3 DockingOperator::striker_from_tool(const DockingOperatorInput& in) const {
  return in.picture.striker_m - in.picture.tool.p;
}

// After a hold, the operator checks the picture and engages again at the present position of the robot.
bool DockingOperator::held(const DockingOperatorInput& in) {
  if (phase_ == DockingPhase::kWait) return false;
  if (in.master->state == SafetyState::kEngaged) {
    if (held_s_) hand_m_ = in.master->p_MH;
    held_s_.reset();
    return false;
  }
  relocating_s_.reset();
  hand_m_ = in.master->p_MH;
  if (!held_s_) held_s_ = in.t_s;
  if (in.t_s - *held_s_ > in.rtt_s + reaction_s_ + 1.0) {
    out_.requests.engage = true;
    held_s_ = in.t_s;
  }
  return true;
}

// Judges the felt force. Returns true if it ends the phase.
bool DockingOperator::judge(const DockingOperatorInput& in) {
  const DockingPhase before = phase_;
  if (phase_ == DockingPhase::kInsert) judge_insertion(in);
  if (phase_ == DockingPhase::kPress && rounds_ > 0) judge_press(in);
  return phase_ != before;
}

// A contact during the insertion is wrong, so the operator gives up.
void DockingOperator::judge_insertion(const DockingOperatorInput& in) {
  if (mistake_ != DockingMistake::kMissesGuide && mistake_ != DockingMistake::kTilted) return;
  if (in.master->spring_force_n.x() < -kFelt_n * ke_ && !felt_s_) felt_s_ = in.t_s;
  if (felt_s_ && in.t_s - *felt_s_ > 1.0) enter(DockingPhase::kRetreat, in);
}

void DockingOperator::judge_press(const DockingOperatorInput& in) {
  const double felt = -in.master->spring_force_n.x() / ke_;
  // With the clutch, the hand feels nothing.
  felt_peak_n_ = relocating_s_ ? 0.0 : std::max(felt_peak_n_, felt);
  if (felt_peak_n_ > kFelt_n && felt < kGone_n) {
    if (!vanished_s_) vanished_s_ = in.t_s;
  } else {
    vanished_s_.reset();
  }
  if (!felt_success_ && vanished_s_ && in.t_s - *vanished_s_ > reaction_s_) {
    felt_success_ = true;
    felt_peak_n_ = 0.0;
    if (mistake_ != DockingMistake::kPushesOn) return enter(DockingPhase::kRelease, in);
  }
  // An operator who keeps pushing touches the seat.
  const bool pushed_on = felt_success_ && felt > kFelt_n;
  if (pushed_on && !felt_s_) felt_s_ = in.t_s;
  if ((felt_s_ && in.t_s - *felt_s_ > 1.0) || in.t_s - entered_s_ > 150.0) enter(DockingPhase::kRelease, in);
}

DockingOperatorOutput DockingOperator::step(const DockingOperatorInput& in) {
  out_ = {};
  if (!held(in)) {
    const bool resting = rests(in);  // judges the felt force nevertheless
    if (!judge(in) && !resting) act(in);
  }
  if (closed_ != asked_) out_.requests.grip = asked_ = closed_;
  out_.target.position_m = hand_m_;
  out_.target.rotation_rad = hand_rad_;
  out_.target.grip = Grip::kFirm;
  return out_;
}

void DockingOperator::act(const DockingOperatorInput& in) {
  switch (phase_) {
    case DockingPhase::kWait:
      if (in.master->state == SafetyState::kEngaged && in.t_s > 2.0 * in.rtt_s + 1.0)
        enter(DockingPhase::kApproach, in);
      return;
    case DockingPhase::kApproach:
      return approach(in);
    case DockingPhase::kReach:
      return reach(in);
    case DockingPhase::kGrasp:
      return grasp(in);
    case DockingPhase::kDrag:
      return drag(in);
    case DockingPhase::kAlign:
      return align(in);
    case DockingPhase::kInsert:
      return insert(in);
    case DockingPhase::kPress:
      return press(in);
    case DockingPhase::kRelease:
      return release(in);
    case DockingPhase::kRetreat:
      return retreat(in);
    case DockingPhase::kDone:
      return;
  }
}

void DockingOperator::approach(const DockingOperatorInput& in) {
  const Vector3 target = in.picture.fixture_m + misjudged_m_ - kStandoff_m * Vector3::UnitX();
  if (drive(in, target, speed_m_per_s_) && looked(in)) enter(DockingPhase::kReach, in);
}

void DockingOperator::reach(const DockingOperatorInput& in) {
  if (carry(in, in.picture.fixture_m + misjudged_m_, speed_m_per_s_) && looked(in))
    enter(DockingPhase::kGrasp, in);
}

void DockingOperator::grasp(const DockingOperatorInput& in) {
  if (!closed_) {
    const bool near = (in.picture.fixture_m + misjudged_m_ - in.picture.tool.p).norm() < 0.008;
    if (!near) return enter(DockingPhase::kReach, in);
    closed_ = true;
    ++grasps_;
  }
  if (!looked(in)) return;
  if (in.picture.load) return enter(DockingPhase::kDrag, in);
  closed_ = false;
  enter(DockingPhase::kReach, in);
}

void DockingOperator::drag(const DockingOperatorInput& in) {
  if (rounds_ == 0) {
    if (!relocate(in, Vector3::Zero())) return;
    aim_m_ = guide_.mouth_m + misjudged_m_ - striker_from_tool(in);
    ++rounds_;
  }
  if (drive(in, aim_m_, speed_m_per_s_) && looked(in)) enter(DockingPhase::kAlign, in);
}

// Aligns the target and moves its tip in front of the funnel, twice: the second time corrects the error of
// the first.
void DockingOperator::align(const DockingOperatorInput& in) {
  if (rounds_ % 2 == 0) {
    const Vector3 tilt_rad = (mistake_ == DockingMistake::kTilted ? kTilt_rad : 0.0) * Vector3::UnitZ();
    const Quaternion straight = exp_rotation(tilt_rad - in.picture.turned_rad - misjudged_rad_);
    const Quaternion change = straight * in.picture.tool.q;
    aim_rad_ = log_rotation(change);
    aim_m_ = guide_.mouth_m + misjudged_m_ - straight * striker_from_tool(in);
    if (mistake_ == DockingMistake::kMissesGuide) aim_m_.z() += kBeside_m;
    ++rounds_;
  }
  turn(in, aim_rad_);
  const bool there = carry(in, aim_m_, speed_m_per_s_) && (aim_rad_ - in.ghost_rad).norm() < 0.003;
  if (!there || !looked(in)) return;
  look_s_.reset();
  if (++rounds_ >= 4) enter(DockingPhase::kInsert, in);
}

void DockingOperator::insert(const DockingOperatorInput& in) {
  if (rounds_ == 0) {
    const double way = guide_.end_m - guide_.mouth_m.x() - kCareful_m;
    aim_m_.x() += way;
    ++rounds_;
  }
  turn(in, aim_rad_);
  if (carry(in, aim_m_, kInsert_m_per_s) && looked(in)) enter(DockingPhase::kPress, in);
}

// Pushes until the force rises and then vanishes.
void DockingOperator::press(const DockingOperatorInput& in) {
  if (rounds_ == 0) {
    if (!relocate(in, {-0.045, 0.0, 0.0})) return;
    aim_m_.x() += kCareful_m + 0.05;
    ++rounds_;
    felt_peak_n_ = 0.0;
  }
  turn(in, aim_rad_);
  carry(in, aim_m_, kPress_m_per_s);
}

void DockingOperator::release(const DockingOperatorInput& in) {
  if (rounds_ == 0) {
    hand_m_ = in.master->p_MH;  // stops pushing
    if (!looked(in)) return;
    closed_ = false;
    look_s_.reset();
    ++rounds_;
  }
  if (looked(in)) enter(DockingPhase::kRetreat, in);
}

void DockingOperator::retreat(const DockingOperatorInput& in) {
  if (rounds_ == 0) {
    aim_m_ = in.ghost_m - 0.08 * Vector3::UnitX();
    ++rounds_;
  }
  if (carry(in, aim_m_, speed_m_per_s_) && looked(in)) enter(DockingPhase::kDone, in);
}

}  // namespace longreach
