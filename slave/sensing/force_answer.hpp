#pragma once
// Distinguishes an approaching wall from a faulty sensor. If the force grows while the setpoint is at rest,
// the robot did not cause the growth. The tool retreats, and the response of the force is evaluated:
//   g = ΔF/Δt at rest, since the touch, over at least 40 ms and 0.4 N or 8 σ, or over 8 ms and half of the
//       bound. The growth must exceed k_max times the motion of the tool towards the contact in that time.
//   D = F_0 + g (t - t_0) - F, where s is the motion of the tool along the force since the start t_0 of the
//       retreat
//
//   state       condition                                                      next
//   rest        the force grows at rest                                        growing
//   growing     the force has reached the bound                                retreating
//   growing     the stiffness is unknown, and the force has reached 2 N          retreating by at most 3 mm
//   either      the guard is exceeded, so the tool retreats anyway, and -D     checking, then retreating
//               as below with g = 0
//   either      the same, but neither D nor -D within 5 mm                     checking; retreating again
//                                                                              if the force grows
//   retreating  s >= 0.1 mm,  D >= 0.5 N or 10 σ, and D >= 100 N/m s           responds: approaching wall
//   retreating  s >= 0.1 mm, -D satisfies the same                             checking: the tool rests
//   checking    at rest as long as it moved (40 to 250 ms), or until 1.6 N     retreating, suspected
//               or 20 σ grew in 8 ms: -D by 0.7 of the bounds above, with the
//               greater of g before and after the retreat
//   checking    the same, and already suspected                                wrong sign
//   checking    otherwise: the wall accelerates, or is stiffer deeper          growing
//   responds    half a second of rest without growth; also from growing        rest
//   any         the contact ends                                               rest
//
// If the force does not respond, the retreat ends when its distance is used up (retreat_budget.hpp). After a
// response, D/s is the stiffness k, and the speed of the retreat is
//   u = v + (F - F_bound)/(k τ),   v = speed of the tool + F'/k, smoothed
// Before the response, the tool accelerates at the fraction g/(250 N/s) of its acceleration limit, but at no
// less than 5 %. A faulty sensor that imitates a response is not detected.

#include <cstdint>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct ForceAnswerInput {
  /// Measured position of the tool in W, with the same delay and filter as the force.
  Vector3 p_m = Vector3::Zero();
  double force_n = 0.0;  // |F|
  /// Unit vector in the direction of the force on the tool, in W.
  Vector3 reaction = Vector3::Zero();
  bool in_contact = false;
  bool still = false;     // the setpoint is at rest, and the tool has reached it
  bool may_move = false;  // false: the tool must not retreat
  double bound_n = 0.0;   // force at which the retreat starts
  /// Force above which the tool retreats anyway, whether or not the force grows while the robot is at rest.
  double guard_n = 0.0;
  double dt = 0.0;  // s, > 0
  /// False: the stiffness of the contact is unknown. If it never was known in this contact, the tool retreats earlier, once,
  /// to learn it. If it was, the force may have changed because the sensor is faulty.
  bool known = true;
};

struct ForceAnswerLimits {
  double noise_n = 0.05;                // σ
  double stiffness_n_per_m = 2e4;       // k_max
  double speed_m_per_s = 0.25;          // maximum speed of the retreat
  double acceleration_m_per_s2 = 1.25;  // maximum acceleration of the retreat
};

class ForceAnswer {
 public:
  enum class State : std::uint8_t { kRest, kGrowing, kGivingWay, kAnswered, kChecking, kWrongSign };

  explicit ForceAnswer(const ForceAnswerLimits& limits) : limits_(limits) {}
  void configure(const ForceAnswerLimits& limits) { limits_ = limits; }
  void reset() { *this = ForceAnswer(limits_); }
  void step(const ForceAnswerInput& in);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool grows() const { return state_ != State::kRest && state_ != State::kWrongSign; }
  [[nodiscard]] bool gives_way() const { return state_ == State::kGivingWay || state_ == State::kAnswered; }
  /// True if gives_way() was true in this contact.
  [[nodiscard]] bool gave_way() const { return gave_way_; }
  [[nodiscard]] bool answered() const { return answered_; }
  /// True if the tool must stay at rest because the force is being checked or has the wrong sign.
  [[nodiscard]] bool rests() const { return state_ == State::kChecking || state_ == State::kWrongSign; }
  [[nodiscard]] double trend_n_per_s() const { return grows() ? trend_.n_per_s : 0.0; }  // g
  /// Returns the stiffness of a wall that has approached in this contact, while the robot is at rest or the force grows,
  /// N/m; otherwise 0.
  [[nodiscard]] double coming_n_per_m() const {
    return answered_here_ && (grows() || still_) ? stiffness_n_per_m_ : 0.0;
  }
  [[nodiscard]] double retreat_m_per_s() const { return gives_way() ? retreat_m_per_s_ : 0.0; }

 private:
  struct Point {
    double t_s = 0.0, force_n = 0.0;
    Vector3 p_m = Vector3::Zero();
  };
  struct Trend {
    double n_per_s = 0.0;
    Vector3 m_per_s = Vector3::Zero();  // speed of the tool, caused by the deflection of the robot
  };
  struct Deviation {
    double fell_n, way_m;  // D and s
  };
  void rest(const Point& now, const ForceAnswerInput& in);
  [[nodiscard]] bool grown(const Point& from, const Point& now, const ForceAnswerInput& in) const;
  void begin_to_give_way(const Point& now, const Vector3& reaction);
  void watch_retreat(const Point& now, const ForceAnswerInput& in);
  void look_for_answer(const Point& now);
  [[nodiscard]] bool seen_enough(const Point& now) const;
  void check(const Point& now, const ForceAnswerInput& in);
  void drive(const Point& now, const ForceAnswerInput& in);
  [[nodiscard]] Deviation deviation(const Point& now, double trend_n_per_s) const;
  [[nodiscard]] bool decides(double change_n, double way_m, double share = 1.0) const;
  [[nodiscard]] static Trend trend(const Point& from, const Point& to);

  ForceAnswerLimits limits_;
  State state_ = State::kRest;
  bool gave_way_ = false, answered_ = false;
  bool answered_here_ = false;  // in this contact
  bool still_ = false;          // in the last step
  bool known_ = false;          // the stiffness was known at some time in this contact
  bool learns_ = false,
       tried_ = false;       // the present retreat is to learn the stiffness; there was one in this contact
  bool watches_ = false;     // true while a retreat caused by the guard is being monitored
  bool tries_ = false;       // true: retreat after the check
  bool follows_ = false;     // true: retreat after the check if the force grows at rest
  bool suspected_ = false;   // the previous retreat made the force grow
  Point older_{}, newer_{};  // start of this rest period, or points of growth in it
  double rest_s_ = 0.0;      // duration of the current rest period
  double moved_s_ = 0.0;     // time since the last rest period
  bool grew_ = false;        // the force grew at rest at the last evaluation
  Trend trend_{}, given_{};  // current trend at rest; trend at the start of the retreat
  Point from_{}, begun_{};   // start of the retreat; start of this rest period
  Vector3 along_ = Vector3::Zero();
  double checked_s_ = 0.0;
  double answered_s_ = 0.0;  // time since the response
  double stiffness_n_per_m_ = 0.0;
  double wall_m_per_s_ = 0.0;     // v
  double retreat_m_per_s_ = 0.0;  // u
  Point before_{};                // values of the previous step
};

}  // namespace longreach
