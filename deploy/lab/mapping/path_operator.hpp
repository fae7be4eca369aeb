#pragma once
// A simulated operator who moves the tool along a path, from one intermediate point (aim) to the next. For
// each aim, the operator moves, waits for a round trip plus a reaction time, reads the displayed position of
// the tool, and then continues or corrects (move and wait, Ferrell 1965). The model has not been validated
// with human operators. The parameters of each operator are random:
//
//   reaction time N(0.25, 0.04) s
//   aimed moves with minimum jerk and the duration a + b log2(d/W + 1), a ~ N(0.25, 0.05) s,
//   b ~ N(0.07, 0.015) s; they end 5 % short, with an error of sd 0.11 lognormal(0.25) d + 0.4 mm per
//   coordinate
//
// where d is the distance that the hand moves and W the width of the target. Position mode: one aimed move
// per target, and a relocation of 1.0 to 1.5 s when the handle would leave its workspace. Rate mode: the
// operator holds a deflection that commands the speed v and changes only its direction from target to target. When
// the displayed remaining distance is less than v (reaction + round trip), the operator releases the handle,
// so that the robot stops and the handle glides home. During the first round trip of a run, while the display
// does not show the motion yet, the operator assumes that the tool has moved by v times the time since the
// run began. In unknown space, v is at most the speed limit that the master displays. Hybrid mode: for each line
// or turn, rate mode until the target is near, then position mode.
//
// The wait starts when the hand is at rest, or when the released handle is within 3 mm of home. With a live
// display, that is, without delay or with prediction, the operator can see the tool arrive. The operator then
// passes intermediate aims without waiting, starts to wait as soon as the handle is released, and continues
// in rate mode as soon as the handle is in the dead zone, or in position mode at any position of the handle.
//
// The model has five free parameters. (1) The time saved by a live display, chosen so that the slowdown of
// each mode due to delay is within the predicted bands. (2) v, chosen so that a run lasts one second. (3)
// kNearSd, which defines "near": ending rate mode earlier is more accurate but slower, as `mapping-trade`
// shows. Its value was chosen with the 100 operators of the seeds 2 to 6 so that the time gained over
// position mode is statistically as significant as the accuracy gained over rate mode. (4) The tolerance of a
// target, 2 mm, which is the radius of the tool in the scene. (5) The workspace that the operator uses, 60 mm
// of the 75 mm of the handle.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/mapping/path_course.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"
#include "schema/config_master.hpp"

namespace longreach {

// In hybrid mode, rate mode ends this many standard deviations before the target. The standard deviation is
// that of an aimed move with the length of the run.
constexpr double kNearSd = 2.1;

enum class PathStrategy : std::uint8_t { kRate, kPosition, kHybrid };
constexpr int kPathStrategies = 3;
std::string_view to_string(PathStrategy strategy);

struct PathPerson {
  double reaction_s = 0.25;
  double aim_s = 0.25, aim_s_per_bit = 0.07;  // a, b
  /// Standard deviation of the end point of an aimed move relative to its length.
  double spread = 0.11;

  static PathPerson draw(Random random);
};

struct PathWork {
  PathStrategy strategy = PathStrategy::kHybrid;
  MappingConfig mapping{};
  double spring_share = 0.0;  // stiffness of the rate-mode spring relative to that of the hand
  Grip grip = Grip::kLight;
  double near_sd = kNearSd;
  /// Delay of the display relative to the hand, s: the round trip, or 0 for a predicted display.
  double late_s = 0.0;
};

struct PathOperatorInput {
  double t_s = 0.0;
  Vector3 shown_m = Vector3::Zero();   // displayed position of the tool relative to its start, W
  Vector3 handle_m = Vector3::Zero();  // relative to home, M
  double approach_m_per_s = 0.0;       // displayed speed limit in unknown space; 0: not limited
};

struct PathOperatorOutput {
  HandTarget target{};
  OperatorRequests requests{};
};

class PathOperator {
 public:
  PathOperator(const PathPerson& person, const PathWork& work, std::vector<PathAim> aims, Random random);

  PathOperatorOutput step(const PathOperatorInput& input);

  [[nodiscard]] bool done() const { return next_ == aims_.size(); }
  /// Index of the current aim.
  [[nodiscard]] std::size_t next() const { return next_; }
  [[nodiscard]] int moves() const { return moves_; }  // number of moves followed by a wait
  [[nodiscard]] int relocations() const { return relocations_; }

 private:
  enum class Phase : std::uint8_t { kLook, kMove, kRelocate, kSteer, kGlide };
  struct Reach {  // minimum-jerk motion of the hand
    Vector3 from_m = Vector3::Zero(), to_m = Vector3::Zero();
    double begin_s = 0.0, lasts_s = 0.0;
    [[nodiscard]] bool over(double t_s) const { return t_s >= begin_s + lasts_s; }
  };

  void act(const PathOperatorInput& in);
  void look(const PathOperatorInput& in);
  void leave_behind();
  void aim_hand(const PathOperatorInput& in);
  void relocate(const PathOperatorInput& in, const Vector3& way_m);
  void steer_from(const PathOperatorInput& in, const Vector3& tool_m);
  void steer(const PathOperatorInput& in);
  void let_go();
  void take_again(const PathOperatorInput& in);
  void wait(const PathOperatorInput& in, bool foreseen);

  [[nodiscard]] bool live() const;
  /// Standard deviation of the end point of an aimed move, per coordinate.
  [[nodiscard]] double sd_of(double length_m) const;
  [[nodiscard]] Vector3 error_of(double length_m);
  [[nodiscard]] double time_of(double length_m, double width_m) const;
  /// Remaining distance along the aims to the end of the line or turn.
  [[nodiscard]] double left_m(const Vector3& from_m) const;
  [[nodiscard]] double unseen_m(double t_s) const;
  [[nodiscard]] double speed_for(double left_m, double approach_m_per_s) const;
  void put_hand(double t_s);

  PathPerson person_;
  PathWork work_;
  std::vector<PathAim> aims_;
  Random random_;
  std::size_t next_ = 0;
  Phase phase_ = Phase::kLook;
  MotionMode mode_;
  bool tried_ = false;  // the operator has moved towards the current aim
  bool ran_ = false;    // a run in rate mode has taken place in this line or turn
  bool away_ = false;   // the handle has been released and has not reached home yet
  double until_s_ = 0.0;
  Reach reach_{};
  Vector3 hand_m_ = Vector3::Zero(), hand_m_per_s_ = Vector3::Zero();  // target of the handle
  Vector3 direction_ = Vector3::UnitX();                               // direction of the run in rate mode
  double speed_m_per_s_ = 0.0, began_s_ = 0.0;                         // speed and start time of the run
  double near_m_ = 0.0;     // hybrid mode: remaining distance that is covered in position mode
  double give_up_s_ = 0.0;  // time at which the run is abandoned if the display shows no result
  std::optional<double> react_s_{};
  int moves_ = 0, relocations_ = 0;
  PathOperatorOutput out_{};
};

}  // namespace longreach
