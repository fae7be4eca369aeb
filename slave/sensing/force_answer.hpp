#pragma once
// A wall that comes, or a sensor that lies? A force that grows while the setpoint stands still is not of the
// robot's doing; what it does when the tool gives way decides:
//   g = ΔF/Δt at rest, from the touch on, over at least 40 ms and 0.4 N or 8 σ, or 8 ms and half of the
//       bound; beyond k_max times the way that the tool itself has come nearer meanwhile
//   D = F_0 + g (t - t_0) - F,   s the tool's way along the force since t_0, when it began to give way
//
//   state       condition                                                      next
//   rest        the force grows at rest                                        growing
//   growing     it has come to the bound                                       giving way
//   both        the guard is exceeded, the tool goes back by itself, -D as     checking, then giving way
//               below with g = 0
//   both        likewise, neither D nor -D on 5 mm                             checking; giving way
//                                                                              again if it grows
//   giving way  s >= 0.1 mm,  D >= 0.5 N or 10 σ, and D >= 100 N/m s           answered: a wall comes
//   giving way  s >= 0.1 mm, -D likewise                                       checking: the tool rests
//   checking    at rest as long as it went, but 40 to 250 ms, or till 1.6 N    giving way, suspected
//               or 20 σ grew in 8 ms, with the greater of g before and after:
//               0.7 of that
//   checking    likewise, and suspected                                        wrong sign
//   checking    otherwise: the wall comes faster, or is stiffer deeper         growing
//   answered    half a second of rest without growth; of growing, too          rest
//   any         the contact ends                                               rest
// Giving way without an answer ends by its length (retreat_budget.hpp). Once answered, D/s is the stiffness k, and
//   u = v + (F - F_bound)/(k τ),   v = the tool's own speed + F'/k, smooth
// is the speed of giving way. Before, it is gained at a share g/(250 N/s) of the acceleration, 5 % at least.
// Not revealed: a sensor that fakes an answer.

#include <cstdint>

#include "common/spatial/spatial.hpp"

namespace longreach {

struct ForceAnswerInput {
  Vector3 p_m = Vector3::Zero();       // measured tool in W, as late and smooth as the force
  double force_n = 0.0;                // |F|
  Vector3 reaction = Vector3::Zero();  // unit, of the force on the tool, in W
  bool in_contact = false;
  bool still = false;     // the setpoint stands, and the tool is there
  bool may_move = false;  // else it gives way to nothing
  double bound_n = 0.0;   // at which giving way begins
  double guard_n = 0.0;   // above which the tool goes back, whatever the force did at rest
  double dt = 0.0;        // s, > 0
};

struct ForceAnswerLimits {
  double noise_n = 0.05;                // σ
  double stiffness_n_per_m = 2e4;       // k_max
  double speed_m_per_s = 0.25;          // of giving way
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
  /// Ever in this contact.
  [[nodiscard]] bool gave_way() const { return gave_way_; }
  [[nodiscard]] bool answered() const { return answered_; }
  /// The tool shall rest.
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
    Vector3 m_per_s = Vector3::Zero();  // of the tool, by what the robot yields
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
  bool watches_ = false;     // a tool that goes back by itself
  bool tries_ = false;       // once at rest, to give way
  bool follows_ = false;     // likewise, if it grows there
  bool suspected_ = false;   // the way before made the force grow
  Point older_{}, newer_{};  // of this rest, or of growth in it
  double rest_s_ = 0.0;      // the present one
  double moved_s_ = 0.0;     // since the last
  bool grew_ = false;        // at the last look
  Trend trend_{}, given_{};  // at rest, now; where giving way began
  Point from_{}, begun_{};   // where giving way began; this rest
  Vector3 along_ = Vector3::Zero();
  double checked_s_ = 0.0;
  double answered_s_ = 0.0;  // since then
  double stiffness_n_per_m_ = 0.0;
  double wall_m_per_s_ = 0.0;     // v
  double retreat_m_per_s_ = 0.0;  // u
  Point before_{};                // a step ago
};

}  // namespace longreach
