#pragma once
// A simulated operator who moves the tool along a path, aim after aim: moves, waits a round trip and a
// reaction time, looks at the displayed position of the tool, continues or corrects (move and wait, Ferrell
// 1965). It is not evidence about people. The parameters of each person are random:
//
//   reaction N(0.25, 0.04) s; aimed moves of minimum jerk, a + b log2(d/W + 1) long, a ~ N(0.25, 0.05) s,
//   b ~ N(0.07, 0.015) s; they end 5 % short, and off by sd 0.11 lognormal(0.25) d + 0.4 mm in each
//   coordinate
//
// with d the distance of the hand. Position mode: an aimed move for each aim; a relocation of 1.0 to 1.5 s
// where the handle would leave its workspace. Rate mode: holds a deflection for the speed v, changes only its
// direction from aim to aim, and releases the handle, which stops the robot and glides home, when the
// displayed remaining distance is less than v (reaction + round trip); until the end of the first round trip
// the operator assumes v times the age of the run, since there is no display yet. Hybrid: in each line or
// turn rate mode until near, then position mode.
//
// The operator waits until the hand is at rest, or the released handle is home (3 mm). With a live display,
// without delay or predicted, the arriving tool is visible: the operator then continues from an intermediate
// aim without waiting, waits from the release of the handle, and continues in rate mode when the handle is in
// the dead zone, in position mode at any position.
//
// The model leaves these parameters open: the time saved by a live display, chosen so that the delay slows
// down each mode within the predicted bands; v (a run lasts a second); near (kNearSd: an earlier end of rate
// mode is more accurate and slower, as `mapping-trade` shows; chosen on the 100 operators of the seeds 2 to
// 6, so that the gain over position in time is as significant as that over rate in accuracy); the tolerance
// of a target (2 mm, the radius of the tool in the scene); and the workspace of the handle (60 mm of 75).

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/mapping/path_course.hpp"
#include "master/config/mapping_config.hpp"
#include "master/devices/hand_target.hpp"
#include "master/master_node.hpp"

namespace longreach {

// Hybrid: rate mode ends this number of sd of an aimed move, over the length of the run, before the target.
constexpr double kNearSd = 2.1;

enum class PathStrategy : std::uint8_t { kRate, kPosition, kHybrid };
constexpr int kPathStrategies = 3;
std::string_view to_string(PathStrategy strategy);

struct PathPerson {
  double reaction_s = 0.25;
  double aim_s = 0.25, aim_s_per_bit = 0.07;  // a, b
  double spread = 0.11;                       // sd of the end of an aimed move relative to its length

  static PathPerson draw(Random random);
};

struct PathWork {
  PathStrategy strategy = PathStrategy::kHybrid;
  MappingConfig mapping{};
  double spring_share = 0.0;  // stiffness of the rate mode spring relative to that of the hand
  Grip grip = Grip::kLight;
  double near_sd = kNearSd;
  /// delay of the display relative to the hand: the round trip; 0 for a predicted display
  double late_s = 0.0;
};

struct PathOperatorInput {
  double t_s = 0.0;
  Vector3 shown_m = Vector3::Zero();   // displayed position of the tool, from its start, W
  Vector3 handle_m = Vector3::Zero();  // from home, M
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
  /// Index of the next aim.
  [[nodiscard]] std::size_t next() const { return next_; }
  [[nodiscard]] int moves() const { return moves_; }  // moves followed by a wait
  [[nodiscard]] int relocations() const { return relocations_; }

 private:
  enum class Phase : std::uint8_t { kLook, kMove, kRelocate, kSteer, kGlide };
  struct Reach {  // motion of the hand, minimum jerk
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
  [[nodiscard]] double sd_of(double length_m) const;  // of the end of an aimed move, per coordinate
  [[nodiscard]] Vector3 error_of(double length_m);
  [[nodiscard]] double time_of(double length_m, double width_m) const;
  [[nodiscard]] double left_m(const Vector3& from_m) const;  // along the aims to the end of the line or turn
  [[nodiscard]] double unseen_m(double t_s) const;
  [[nodiscard]] double speed_for(double left_m) const;
  void put_hand(double t_s);

  PathPerson person_;
  PathWork work_;
  std::vector<PathAim> aims_;
  Random random_;
  std::size_t next_ = 0;
  Phase phase_ = Phase::kLook;
  MotionMode mode_;
  bool tried_ = false;  // there was a move for the next aim
  bool ran_ = false;    // in rate mode, in this line or turn
  bool away_ = false;   // the handle is released and not home yet
  double until_s_ = 0.0;
  Reach reach_{};
  Vector3 hand_m_ = Vector3::Zero(), hand_m_per_s_ = Vector3::Zero();  // target of the handle
  Vector3 direction_ = Vector3::UnitX();                               // of the run in rate mode
  double speed_m_per_s_ = 0.0, began_s_ = 0.0;                         // likewise
  double near_m_ = 0.0;     // hybrid: distance of the run that is left to position mode
  double give_up_s_ = 0.0;  // if there was no result
  std::optional<double> react_s_{};
  int moves_ = 0, relocations_ = 0;
  PathOperatorOutput out_{};
};

}  // namespace longreach
