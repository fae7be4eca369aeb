#include "slave/estimation/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace longreach {
namespace {

constexpr double kDirectionMemoryS = 2.0;  // noise of 0.05 N makes the normal of 0.5 N wrong by 2 mrad
constexpr double kKnownSamples = 300.0;    // weight of the normal of a surface that is touched again
constexpr std::size_t kLast = 64;          // samples before the touch that always count
constexpr double kStraight = 1.33;         // squared ratio of distance to depth, 30 degrees
constexpr double kSamePlaceM = 0.003;      // tolerance for touching a known surface again
constexpr double kHistoryGoals = 4000.0;   // goals that the playout certainly still stores (it keeps 8192)
constexpr double kStepMaxM = 1.0;          // maximum motion between two samples; more is not a measurement
constexpr double kReplacedSd = 3.0;        // sd: the surface is not where it was at the previous touch
constexpr double kSlideM = 1e-3;      // motion along the surface after which its position is reported again
constexpr double kRefined = 0.1;      // rad by which a normal may become more accurate
constexpr double kSharpestM = 2e-3;   // minimum radius of curvature
constexpr double kUsualPress = 10.0;  // usual pressing force of a hand, in touch thresholds
constexpr double kLocal = 2.0;        // times the memory of the depth
constexpr double kGoalAtM = 1e-3;     // tolerance for a goal at the surface
constexpr double kBeforeM = 5e-3;     // permitted depth beyond twice the range of the motion
// A tool at rest gives no better estimate: it moves by less than this share of its range for this time.
constexpr double kStillShare = 0.05, kStill_s = 0.5;
constexpr double kStillSd =
    0.25;  // then enough for a first report, whose line passes through the measured force

constexpr double kRecent_s = 0.1;   // after which a force counts as less than half
constexpr double kClearly = 4.0;    // touch thresholds: a force whose sudden end is noticed
constexpr double kForceGone = 2.0;  // of the remaining force: otherwise the force has changed, not vanished
constexpr double kMisplaced = 0.1;  // of the pressed depth: error of the place if no law fits exactly
constexpr double kHardly = 0.25;    // of the motion that ends a force: the surface has gone, not the tool

WatchedIdentifier identifier(const EstimatorConfig& c, const SensingConfig& sensing) {
  return WatchedIdentifier({c.kind, c.exponent, c.forgetting, sensing.force_noise_n, 0.0, false});
}

}  // namespace

Surface::Surface(const SensingConfig& sensing, const EstimatorConfig& estimator)
    : sensing_(with_thresholds(sensing)),
      estimator_(estimator),
      identifier_(identifier(estimator, sensing)),
      reported_(estimator),
      touch_n_(sensing_.touch_n) {}

void Surface::configure(const SensingConfig& sensing, const EstimatorConfig& estimator) {
  const bool other = estimator.kind != estimator_.kind || estimator.exponent != estimator_.exponent ||
                     estimator.forgetting != estimator_.forgetting;
  if (other) identifier_ = identifier(estimator, sensing);
  sensing_ = with_thresholds(sensing);
  if (sensing.touch_n > 0.0) touch_n_ = sensing.touch_n;
  estimator_ = estimator;
  reported_.configure(estimator);
}

bool Surface::crossed(const Vector3& normal, const Vector3& from, const Vector3& to) const {
  return known_ && normal.dot(known_normal_) > kSameNormal &&
         known_normal_.dot(from - known_point_m_) > -kSamePlaceM &&
         known_normal_.dot(to - known_point_m_) < kSamePlaceM;
}

void Surface::begin(const Touch& touch, bool again, const Ring<TouchSample>& before) {
  there_ = pressed_ = true;
  known_ = again;
  touch_ = touch.number;
  const double variance_n2 = sensing_.force_noise_n * sensing_.force_noise_n;
  sum_n_ = touch.force_n;
  normal_variance_n2_ = variance_n2;
  // What is known counts like a few tenths of a second of this force.
  if (again) sum_n_ += kKnownSamples * touch.force_n.stableNorm() * known_normal_;
  if (again) normal_variance_n2_ += kKnownSamples * variance_n2;
  normal_ = sum_n_.stableNormalized();
  identifier_.begin();
  local_.begin();
  if (!again) working_.begin();
  reported_.begin(again);
  local_reported_ = {};
  answer_ = {};
  tool_m_ = touch.p_WE;
  inward_m_ = marked_m_ = 0.0;
  surface_m_ = -normal_.dot((known_ ? known_point_m_ : touch.onset) - tool_m_);
  least_m_ = std::min(surface_m_, 0.0);
  most_m_ = 0.0;
  lately_ = {};
  still_at_m_ = still_s_ = 0.0;
  coming_ = false;
  // As far in front of the onset as the tool is behind it.
  const double first_m = -2.0 * normal_.dot(touch.onset - tool_m_);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const TouchSample& at = before[i];
    const Vector3 way_m = tool_m_ - at.p_WE;
    const double x_m = normal_.dot(way_m);
    // With an inaccurate normal, sideways motion would count as depth.
    const bool across = before.size() - i > kLast && way_m.squaredNorm() > kStraight * x_m * x_m;
    if (x_m >= first_m && !across)
      identifier_.step({x_m, -normal_.dot(at.v_WE), normal_.dot(at.force_n)}, 0.0);
  }
  if (!again) placed_sd_m_ = reported_s_ = pressed_to_m_ = turned_s_ = 0.0;
  touched_anew_ = again;
  pushes_ = reported_normal_ = {known_ ? known_normal_ : normal_, touch.p_WE};
  scale_ = touch.scale;
  played_at_touch_ = touch.played_sequence;
  touch_sequence_ = 0.0;
}

// Depth is the motion of the tool against the force. Neither a slide along the surface nor its curvature
// counts as depth, which with a mean direction would have a long lever.
void Surface::press(const Press& press) {
  const Vector3 outward = pushes_.accepted_value(press.outward, press.p_WE, known_);
  const double out_m = outward.dot(press.p_WE - tool_m_);
  const bool possible = std::abs(out_m) < kStepMaxM;
  if (possible) {
    inward_m_ -= out_m;
    least_m_ = std::min(least_m_, inward_m_);
    most_m_ = std::max(most_m_, inward_m_);
    tool_m_ = press.p_WE;
  }
  alone_ = press.alone;
  still_s_ += press.dt;
  if (std::abs(inward_m_ - still_at_m_) > kStillShare * (most_m_ - least_m_))
    still_at_m_ = inward_m_, still_s_ = 0.0;
  speed_m_per_s_ = -outward.dot(press.v_WE);
  lately_.force_n *= std::exp(-press.dt / kRecent_s);
  const double force_n = outward.dot(press.force_n);
  if (force_n >= lately_.force_n) lately_ = {force_n, inward_m_, reported_.stiffness_n_per_m()};
  if (press.coming_n_per_m > 0.0) return come(press.coming_n_per_m, force_n);
  if (std::exchange(coming_, false)) {
    // The samples so far are not those of a surface at rest.
    identifier_.begin();
    local_.begin();
    changes_ = reported_changes_ = 0;
    working_.begin_at(inward_m_ - surface_m_);
  }
  if (!press.learns) return;
  identifier_.step({possible ? inward_m_ : std::nan(""), speed_m_per_s_, force_n}, press.dt);
  if (possible)
    local_.step({inward_m_, speed_m_per_s_, force_n}, surface_m_, kLocal * estimator_.depth_memory_s,
                press.dt);
  identify(press);
}

void Surface::identify(const Press& press) {
  answer_ = identifier_.answer();
  const double present_m = inward_m_ - answer_.surface.value;
  if (answer_.changes != changes_) settled_ = false;
  changes_ = answer_.changes;
  if (!settled_ && well_known(answer_)) {
    working_.begin_at(present_m);
    settled_ = true;
  }
  // A depth that was reached before the operator felt the surface, or at which the guard holds the tool, is
  // not the choice of the operator.
  const double usual_m = this->usual_m();
  bool elsewhere = false;
  if (reported_.stiffness_n_per_m() > 0.0) reported_s_ += press.dt;
  const bool chosen = reported_s_ > press.news_age_s && !press.guarded;
  if (well_known(answer_) && (chosen || changes_ > 0))
    elsewhere = working_.follow(usual_m, present_m, answer_.n.value, estimator_.depth_memory_s, press.dt);
  const bool fits = identifier_.reported().law_fits();
  if (!fits) elsewhere = beside(possible(answer_.surface.value) ? answer_.surface.value : least_m_);
  double asked_m = working_.depth_m(usual_m);
  ContactAnswer reported = fits ? identifier_.reported().answer_at(asked_m) : local_reported_;
  // Uses the nearest depth that was reached, instead of extrapolating far. What is enough at rest is not enough elsewhere.
  const bool near = reported.stiffness.sd < estimator_.first_sd * reported.stiffness.value;
  if (fits && reported.valid && !(near && well_known(reported)))
    reported = identifier_.reported().answer_at(identifier_.reported().visited(reported.depth_m));
  if (!possible(reported.surface.value)) reported.valid = false;
  // A value reported for another contact does not count.
  if (!fits || reported_changes_ != changes_) asked_m = reported.depth_m;
  const bool anew = update_report(reported, asked_m, elsewhere);
  if (!well_known(answer_)) return;
  known_ = true;
  known_normal_ = normal_;
  keep_law();
  known_point_m_ = point();
  const double moved_m = std::abs(normal_.dot(known_point_m_ - place_m_));
  const bool elsewhere_now = touched_anew_ && moved_m > kReplacedSd * answer_.surface.sd;
  if (anew || placed_sd_m_ <= 0.0 || answer_.surface.sd < 0.5 * placed_sd_m_ || elsewhere_now ||
      across_m(placed_at_m_) > kSlideM)
    place();
  constexpr double kTwice = 2.0, kMost = 0.1, kRounding = 1.05, kSd = 3.0;
  pressed_to_m_ = std::max(pressed_to_m_, most_m_ - surface_m_);
  moved_back_m_ = 0.0;
  const double twice_m = std::pow(kTwice * touch_n_ / answer_.k.value, 1.0 / answer_.n.value);
  proof_m_ = std::min(kRounding * twice_m, kMost) + kSd * answer_.surface.sd;
}

void Surface::keep_law() {
  known_k_ = answer_.k.value, known_lambda_ = answer_.lambda.value, known_n_ = answer_.n.value;
  surface_m_ = answer_.surface.value;
}

void Surface::come(double stiffness_n_per_m, double force_n) {
  constexpr double kSd = 0.1;  // relative, of a stiffness that a short retreat has shown
  coming_ = known_ = settled_ = true;
  known_k_ = stiffness_n_per_m, known_lambda_ = 0.0, known_n_ = 1.0;
  const double k = stiffness_n_per_m, depth_m = std::max(0.0, force_n / k);
  answer_ = {};
  ContactAnswer line;
  line.valid = true;
  line.stiffness = line.secant = {k, kSd * k, Verdict::kNotYet};
  line.depth_m = depth_m;
  reported_.step(line, reported_normal_.accepted_value(normal_, tool_m_, known_), depth_m, false, 2.0 * kSd);
  const double reported = reported_.stiffness_n_per_m();
  if (!(reported > 0.0)) return;
  surface_m_ = inward_m_ - std::max(0.0, force_n / reported) - reported_.foot_m();
  least_m_ = std::min(least_m_, surface_m_);
  known_normal_ = normal_;
  known_point_m_ = place_m_ = point();
  placed_at_m_ = reported_at_m_ = tool_m_;
  placed_sd_m_ = kSd * depth_m;
}

double Surface::usual_m() const {
  return identifier_.reported().depth_of(kUsualPress * scale_ * sensing_.touch_n);
}

bool Surface::update_report(const ContactAnswer& answer, double asked_m, bool elsewhere) {
  const Vector3 normal = reported_normal_.accepted_value(normal_, tool_m_, known_);
  if (!reported_.step(answer, normal, asked_m, elsewhere, first_sd())) return false;
  reported_changes_ = changes_;
  reported_at_m_ = tool_m_ + (inward_m_ - answer.surface.value - reported_.depth_m()) * normal_;
  return true;
}

/// Where no law fits, uses the tangent of the samples alone, held until the mean depth has changed. Returns
/// true if it changed.
bool Surface::beside(double surface_m) {
  const ContactAnswer now = local_.answer(surface_m);
  if (!now.valid) return false;
  const double off = std::abs(now.stiffness.value / std::max(local_reported_.stiffness.value, 1e-12) - 1.0);
  if (local_reported_.valid && off < estimator_.deadband) return false;
  local_reported_ = now;
  local_reported_.k = local_reported_.n = {1.0, 0.0, Verdict::kNoPowerLaw};
  return true;
}

void Surface::place() {
  place_m_ = known_point_m_;
  placed_at_m_ = tool_m_;
  placed_sd_m_ = answer_.surface.sd;
  touched_anew_ = false;
  reported_.place(identifier_.reported().law_fits() ? identifier_.reported().answer_at(reported_.depth_m())
                                                    : local_reported_);
}

double Surface::across_m(const Vector3& from) const { return Vector3(tool_m_ - from).cross(normal_).norm(); }

// A force that turns by more than a slide around an edge permits is not that of the surface: the zero of the
// sensor has changed.
Vector3 Surface::Direction::accepted_value(const Vector3& n, const Vector3& tool, bool known) {
  const double way_m = Vector3(tool - at_m).cross(normal).norm();
  if (known && normal.cross(n).norm() > kRefined + way_m / kSharpestM) return normal;
  if (!known || way_m > kSlideM) *this = {n, tool};
  return n;
}

void Surface::turn(const Vector3& force_n, double dt) {
  const double kept = std::exp(-dt / kDirectionMemoryS);
  turned_s_ += dt;
  sum_n_ = kept * sum_n_ + force_n;
  normal_variance_n2_ = kept * kept * normal_variance_n2_ + sensing_.force_noise_n * sensing_.force_noise_n;
  normal_ = sum_n_.stableNormalized();
}

double Surface::normal_sd() const {
  const double sum_n = sum_n_.stableNorm();
  return sum_n > 0.0 ? std::sqrt(normal_variance_n2_) / sum_n : 1.0;
}

bool Surface::moved_back(double by_m) {
  if (!(moved_back_m_ + by_m < kMisplaced * pressed_to_m_)) return false;
  moved_back_m_ += by_m;
  known_point_m_ -= by_m * normal_;
  place_m_ -= by_m * reported_.normal();
  forget_goals();
  return true;
}

void Surface::release(double force_n) {
  pressed_ = false;
  const double usual_m = this->usual_m();
  working_.leave(usual_m);
  const double asked_m = working_.depth_m(usual_m);
  update_report(identifier_.reported().answer_at(asked_m), asked_m, true);
  there_ = known_ && reported_.stiffness_n_per_m() > 0.0;
  normal_ = known_normal_;
  answer_ = {};
  if (gave_way(force_n)) forget();
}

bool Surface::gave_way(double force_n) const {
  return lately_.force_n > std::max(kClearly * touch_n_, kForceGone * force_n) &&
         lately_.stiffness_n_per_m > 0.0 &&
         lately_.stiffness_n_per_m * (lately_.inward_m - inward_m_) < kHardly * lately_.force_n;
}

void Surface::move_origin(const Vector3& by) {
  for (Vector3* place : {&known_point_m_, &tool_m_, &reported_at_m_, &place_m_, &placed_at_m_, &pushes_.at_m,
                         &reported_normal_.at_m})
    *place -= by;
}

/// After noise or a change of the material, a fit may contain no sample in front of the surface, so its
/// surface may be anywhere.
bool Surface::possible(double surface_m) const {
  return inward_m_ - surface_m < kBeforeM + 2.0 * (most_m_ - least_m_);
}

bool Surface::well_known(const ContactAnswer& a) const {
  return a.valid && possible(a.surface.value) && a.k.value > 0.0 && a.n.value > 0.0 &&
         a.stiffness.sd < first_sd() * a.stiffness.value;
}

double Surface::first_sd() const {
  // A force that changes its direction in contact may be due to a faulty sensor.
  const bool first = !known_ || !(reported_.stiffness_n_per_m() > 0.0);
  const bool waits = first && alone_ && still_s_ > kStill_s;
  return waits ? std::max(estimator_.first_sd, kStillSd) : estimator_.first_sd;
}

void Surface::locate(const Playout& playout, const Vector3& anchor, double played_sequence) {
  if (played_sequence - played_at_touch_ > kHistoryGoals) return forget_goals();
  if (!pressed_ || played_at_touch_ <= 0.0) return;
  const bool placed = placed_sd_m_ > 0.0;
  const Vector3 normal = placed ? reported_.normal() : normal_, at = placed ? place_m_ : point();
  const auto crossing = playout.crossing(-normal, at - anchor, played_at_touch_, kGoalAtM);
  touch_sequence_ =
      crossing.value_or(0.0);  // none: before the first goal, a goal was lost, or the surface moves
}

double Surface::depth_m() const { return pressed_ ? std::max(inward_m_ - surface_m_, 0.0) : 0.0; }

double Surface::proof_depth_m() const { return proof_m_; }

std::optional<double> Surface::law_n(const Vector3& tool) const {
  if (!pressed_ || !known_) return std::nullopt;
  const double depth_m = inward_m_ + normal_.dot(tool_m_ - tool) - surface_m_;
  return known_k_ * std::pow(std::max(0.0, depth_m), known_n_);
}

std::optional<double> Surface::foreseen_n() const {
  if (!pressed_ || !known_) return std::nullopt;
  return std::max(0.0, std::pow(depth_m(), known_n_) * (known_k_ + known_lambda_ * speed_m_per_s_));
}

}  // namespace longreach
