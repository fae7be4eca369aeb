#include "slave/kinematics/arm_loop.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace longreach {
namespace {

constexpr int kSpecialPlaces = 4;  // 1-2-3, 2-3-4, 3-4-5, 4-5-6
constexpr double kNearMissMax = 0.02;
constexpr double kApart = 1e-9;  // of the length: parallel axes nearer to each other count as one

// Tz(before) Tx(a) Rx(α) Tz(behind)
struct LinkRow {
  double before_m = 0.0, a_m = 0.0, alpha_rad = 0.0, behind_m = 0.0;
};

double snapped(double x) { return std::abs(x) < 4e-16 ? 0.0 : x; }

Rigid rotation_x(double alpha_rad) {
  const double c = snapped(std::cos(alpha_rad)), s = snapped(std::sin(alpha_rad));
  Rigid X;
  X.R << 1, 0, 0, 0, c, -s, 0, s, c;
  return X;
}

Rigid shift(double x_m, double z_m) { return {Matrix3::Identity(), Vector3(x_m, 0, z_m)}; }

Rigid to_rigid(const LinkRow& row) {
  return shift(row.a_m, row.before_m) * rotation_x(row.alpha_rad) * shift(0.0, row.behind_m);
}

struct Reading {
  ArmFamily family;
  int first_joint;
  bool backwards;
  double tolerance;
};

// The links in loop order, before they are simplified. The one with the pose keeps its slides in a LinkRow,
// too.
struct OpenLoop {
  std::array<LoopJoint, 6> joint{};
  std::array<LinkRow, 6> row{};
  std::size_t pose = 0;
};

OpenLoop unroll(const Kinematics& arm, const Reading& reading) {
  OpenLoop loop;
  const int step = reading.backwards ? 5 : 1;  // modulo 6
  const int start = reading.backwards ? reading.first_joint + 5 : reading.first_joint + 3;
  for (std::size_t role = 0; role < 6; ++role) {
    const int i = (start + static_cast<int>(role) * step) % 6;
    const auto& links = arm.links();
    loop.joint[role] = {i, reading.backwards ? -1.0 : 1.0, links[static_cast<std::size_t>(i)].theta_rad};
    const int behind = reading.backwards ? (i + 5) % 6 : i;  // the link after this joint is that of this row
    if (behind == 5) {
      loop.pose = role;
      continue;
    }
    const JointRow& l = links[static_cast<std::size_t>(behind)];
    loop.row[role] = reading.backwards ? LinkRow{0.0, -l.a_m, -l.alpha_rad, -l.d_m}
                                       : LinkRow{l.d_m, l.a_m, l.alpha_rad, 0.0};
  }
  return loop;
}

// Offsets along an axis pass through its joint: off the link `role`, onto those beside it.
void slide_off(OpenLoop& loop, std::size_t role) {
  LinkRow& row = loop.row[role];
  loop.row[(role + 5) % 6].behind_m += row.before_m;
  loop.row[(role + 1) % 6].before_m += row.behind_m;
  row.before_m = row.behind_m = 0.0;
}

// Parallel axes may point against each other: the joint behind `role` is counted the other way round, with
// Rx(π) on both sides of it. The half turn before the next link goes where it is asked to.
void align(OpenLoop& loop, std::size_t role, bool& flip_next) {
  LinkRow& row = loop.row[role];
  if (flip_next) {
    row.before_m = -row.before_m;
    row.alpha_rad += std::numbers::pi;
  }
  flip_next = std::cos(row.alpha_rad) < 0.0;
  if (!flip_next) return;
  row.alpha_rad += std::numbers::pi;
  row.behind_m = -row.behind_m;
  loop.joint[role + 1].sign *= -1.0;
}

// Within the tolerance of a reading.
struct NearZero {
  double tolerance, length_m;
  [[nodiscard]] bool angle(double sine) const { return std::abs(sine) <= tolerance; }
  [[nodiscard]] bool length(double x_m) const { return std::abs(x_m) <= tolerance * length_m; }
};

bool applies(const Kinematics& arm, const Reading& reading) {
  const auto i = static_cast<std::size_t>(reading.first_joint);
  const JointRow &one = arm.links()[i], &two = arm.links()[i + 1];
  const NearZero zero{reading.tolerance, arm.motion_length_m()};
  for (const JointRow& row : arm.links()) {
    if (!zero.angle(row.beta_rad)) return false;
  }
  const bool parallel = zero.angle(std::sin(one.alpha_rad)) && zero.angle(std::sin(two.alpha_rad));
  const bool apart = std::abs(one.a_m) > kApart * arm.motion_length_m() &&
                     std::abs(two.a_m) > kApart * arm.motion_length_m();
  if (reading.family == ArmFamily::kParallel) return parallel && apart;
  const bool meet = zero.length(one.a_m) && zero.length(two.a_m) && zero.length(two.d_m);
  const bool turned = !zero.angle(std::sin(one.alpha_rad)) && !zero.angle(std::sin(two.alpha_rad));
  return meet && turned;
}

// The last link ends in the tool, the first one begins at the base. `flip`: a half turn is left for L_f.
void put_ends(const Kinematics& arm, const Reading& reading, const OpenLoop& open, bool flip, ArmLoop& loop) {
  const JointRow& end = arm.links()[5];
  const Rigid tip = to_rigid(LinkRow{end.d_m, end.a_m, end.alpha_rad, 0.0}) * arm.tool();
  const LinkRow around = open.row[open.pose];
  loop.before = shift(0.0, around.before_m) * (reading.backwards ? inverse(arm.base()) : tip);
  loop.behind = (reading.backwards ? inverse(tip) : arm.base()) * shift(0.0, around.behind_m);
  for (const std::size_t role : {ArmLoop::kB, ArmLoop::kC, ArmLoop::kF}) {
    if (role != open.pose) loop.link[role] = to_rigid(open.row[role]);
  }
  if (flip) {
    const Rigid half = rotation_x(std::numbers::pi);
    if (open.pose == ArmLoop::kF) {
      loop.before = half * loop.before;
    } else {
      loop.link[ArmLoop::kF] = half * loop.link[ArmLoop::kF];
    }
  }
  loop.straight = loop.before.R == Matrix3::Identity() && loop.behind.R == Matrix3::Identity();
  loop.family = reading.family;
  loop.first_joint = reading.first_joint;
  loop.joint = open.joint;
  loop.pose_role = open.pose;
  loop.backwards = reading.backwards;
}

// The loop of a reading that applies; nothing if L_a holds the pose, or its axes coincide.
std::optional<ArmLoop> close(const Kinematics& arm, const Reading& reading) {
  OpenLoop open = unroll(arm, reading);
  if (open.pose == ArmLoop::kA) return std::nullopt;
  ArmLoop loop;
  bool flip = false;
  if (reading.family == ArmFamily::kParallel) {
    align(open, ArmLoop::kD, flip);
    align(open, ArmLoop::kE, flip);
    // All offsets along the common direction add up.
    for (const std::size_t role : {ArmLoop::kD, ArmLoop::kE}) {
      LinkRow& row = open.row[role];
      open.row[ArmLoop::kF].before_m += (flip ? -1.0 : 1.0) * (row.before_m + row.behind_m);
      row.before_m = row.behind_m = 0.0;
    }
    loop.first = open.row[ArmLoop::kD].a_m;
    loop.second = open.row[ArmLoop::kE].a_m;
  } else {
    slide_off(open, ArmLoop::kD);
    slide_off(open, ArmLoop::kE);
    const Matrix3 d = rotation_x(open.row[ArmLoop::kD].alpha_rad).R,
                  e = rotation_x(open.row[ArmLoop::kE].alpha_rad).R;
    loop.first = d(2, 1), loop.first_cos = d(2, 2);
    loop.second = e(2, 1), loop.second_cos = e(2, 2);
  }
  slide_off(open, ArmLoop::kA);
  const LinkRow& a = open.row[ArmLoop::kA];
  const NearZero zero{reading.tolerance, arm.motion_length_m()};
  loop.a_m = zero.length(a.a_m) ? 0.0 : a.a_m;
  loop.sin_alpha = zero.angle(std::sin(a.alpha_rad)) ? 0.0 : std::sin(a.alpha_rad);
  loop.cos_alpha =
      loop.sin_alpha == 0.0 ? std::copysign(1.0, std::cos(a.alpha_rad)) : rotation_x(a.alpha_rad).R(2, 2);
  if (loop.a_m == 0.0 && loop.sin_alpha == 0.0) return std::nullopt;
  loop.triangular = loop.a_m == 0.0 || loop.sin_alpha == 0.0;
  loop.nearly = reading.tolerance > kRowTolerance;
  loop.miss_max = loop.nearly ? kNearMissMax : loop.miss_max;
  put_ends(arm, reading, open, flip, loop);
  return loop;
}

// With parallel a and b, c follows from a plane: exact where it vanishes, too.
int rank(const ArmLoop& loop) {
  if (loop.family == ArmFamily::kNone) return 0;
  return loop.sin_alpha == 0.0 ? 3 : loop.triangular ? 2 : 1;
}

}  // namespace

ArmLoop recognise(const Kinematics& arm) {
  ArmLoop best;
  if (!arm.all_revolute()) return best;
  for (const double tolerance : {kRowTolerance, kNearTolerance}) {
    for (const ArmFamily family : {ArmFamily::kSpherical, ArmFamily::kParallel}) {
      for (int first = 0; first < kSpecialPlaces; ++first) {
        for (const bool backwards : {false, true}) {
          const Reading reading{family, first, backwards, tolerance};
          if (!applies(arm, reading)) continue;
          const auto loop = close(arm, reading);
          if (loop && rank(*loop) > rank(best)) best = *loop;
        }
      }
    }
    if (best.family != ArmFamily::kNone) break;
  }
  return best;
}

std::string_view words(const ArmLoop& loop) {
  if (loop.family == ArmFamily::kNone) return "no closed form: solved numerically";
  // "closed form, quadratic: axes 4-5-6 meet", and so on.
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> all;
    for (const char* how : {"closed form, ", "closed form of a similar arm, then Newton steps, "}) {
      for (const char* degree : {"fourth degree: axes ", "quadratic: axes "}) {
        for (const char* family : {" intersect", " parallel"}) {
          for (int first = 1; first <= kSpecialPlaces; ++first) {
            const auto number = [first](int i) { return std::to_string(first + i); };
            all.push_back(std::string(how) + degree + number(0) + "-" + number(1) + "-" + number(2) + family);
          }
        }
      }
    }
    return all;
  }();
  const int row =
      (loop.nearly ? 4 : 0) + (loop.triangular ? 2 : 0) + (loop.family == ArmFamily::kParallel ? 1 : 0);
  return kWords[static_cast<std::size_t>(row * kSpecialPlaces + loop.first_joint)];
}

}  // namespace longreach
