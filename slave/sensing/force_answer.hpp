#pragma once
// Distinguishes an approaching wall from a faulty sensor. If the force grows while the setpoint is at rest,
// the robot did not cause it; the response of the force to a retreat of the tool decides:
//   g = ΔF/Δt at rest, from the touch on, over at least 40 ms and 0.4 N or 8 σ, or 8 ms and half of the
//       bound; beyond k_max times the motion of the tool towards it meanwhile
//   D = F_0 + g (t - t_0) - F,   s the motion of the tool along the force since t_0, the start of the retreat
//
//   state       condition                                                      next
//   rest        the force grows at rest                                        growing
//   growing     it has reached the bound                                       retreating
//   both        the guard is exceeded, the tool retreats by itself, -D as      checking, then retreating
//               below with g = 0
//   both        likewise, neither D nor -D over 5 mm                           checking; retreating
//                                                                              again if it grows
//   retreating  s >= 0.1 mm,  D >= 0.5 N or 10 σ, and D >= 100 N/m s           responds: approaching wall
//   retreating  s >= 0.1 mm, -D likewise                                       checking: the tool rests
//   checking    at rest as long as it moved, 40 to 250 ms, or until 1.6 N      retreating, suspected
//               or 20 σ grew in 8 ms, by 0.7 of the greater of g before and
//               after
//   checking    likewise, and suspected                                        wrong sign
//   checking    otherwise: the wall accelerates, or is stiffer deeper          growing
//   responds    half a second of rest without growth; of growing, too          rest
//   any         the contact ends                                               rest
// A retreat without a response ends by its distance (retreat_budget.hpp). After a response, D/s is the
// stiffness k, and
//   u = v + (F - F_bound)/(k τ),   v = the tool's own speed + F'/k, smooth
// is the speed of the retreat. Before, it is reached at a share g/(250 N/s) of the acceleration, at least 5
// %. Not detected: a faulty sensor that imitates a response.

#include <cstdint>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct ForceAnswerInput {
  Vector3 p_m = Vector3::Zero();       // measured tool in W, with the same delay and filter as the force
  double force_n = 0.0;                // |F|
  Vector3 reaction = Vector3::Zero();  // unit vector, of the force on the tool, in W
  bool in_contact = false;
  bool still = false;     // the setpoint is at rest, and the tool has reached it
  bool may_move = false;  // otherwise it does not retreat
  double bound_n = 0.0;   // start of the retreat
  double guard_n = 0.0;   // above it the tool retreats, regardless of the force at rest
  double dt = 0.0;        // s, > 0
};

struct ForceAnswerLimits {
  double noise_n = 0.05;                // σ
  double stiffness_n_per_m = 2e4;       // k_max
  double speed_m_per_s = 0.25;          // of the retreat
  double acceleration_m_per_s2 = 1.25;  // likewise
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
  /// At any time in this contact.
  [[nodiscard]] bool gave_way() const { return gave_way_; }
  [[nodiscard]] bool answered() const { return answered_; }
  /// The tool must rest.
  [[nodiscard]] bool rests() const { return state_ == State::kChecking || state_ == State::kWrongSign; }
  [[nodiscard]] double trend_n_per_s() const { return grows() ? trend_.n_per_s : 0.0; }  // g
  [[nodiscard]] double retreat_m_per_s() const { return gives_way() ? retreat_m_per_s_ : 0.0; }

 private:
  struct Point {
    double t_s = 0.0, force_n = 0.0;
    Vector3 p_m = Vector3::Zero();
  };
  struct Trend {
    double n_per_s = 0.0;
    Vector3 m_per_s = Vector3::Zero();  // of the tool, from the deflection of the robot
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
  bool watches_ = false;     // monitors a tool that retreats by itself
  bool tries_ = false;       // when at rest, retreat
  bool follows_ = false;     // likewise, if the force grows there
  bool suspected_ = false;   // the previous retreat made the force grow
  Point older_{}, newer_{};  // of this rest, or of growth in it
  double rest_s_ = 0.0;      // the present one
  double moved_s_ = 0.0;     // since the last
  bool grew_ = false;        // at the last evaluation
  Trend trend_{}, given_{};  // at rest, now; at the start of the retreat
  Point from_{}, begun_{};   // start of the retreat; start of this rest
  Vector3 along_ = Vector3::Zero();
  double checked_s_ = 0.0;
  double answered_s_ = 0.0;  // since the response
  double stiffness_n_per_m_ = 0.0;
  double wall_m_per_s_ = 0.0;     // v
  double retreat_m_per_s_ = 0.0;  // u
  Point before_{};                // previous step
};

}  // namespace longreach
