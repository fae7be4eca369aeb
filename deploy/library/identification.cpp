#include "deploy/library/include/longreach/identification.hpp"

#include <cmath>
#include <string>

#include "deploy/library/files.hpp"
#include "slave/estimation/identifier.hpp"

namespace longreach {
namespace {

ContactVerdict verdict_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotYet:
      return ContactVerdict::kTooFewSamples;
    case Verdict::kIdentified:
      return ContactVerdict::kIdentified;
    case Verdict::kNotIdentifiable:
      return ContactVerdict::kNotIdentifiable;
    case Verdict::kNoPowerLaw:
      break;
  }
  return ContactVerdict::kNoPowerLaw;
}

ContactParameter parameter(const Identified& p) { return {p.value, p.sd, verdict_of(p.verdict)}; }

IdentifierConfig config_of(const ContactOptions& options) {
  constexpr double kMost = 1e6;
  require_range("force_noise_n", options.force_noise_n, 0.0, kMost);
  require_range("position_noise_m", options.position_noise_m, 0.0, kMost);
  if (options.surface_m) require_range("surface_m", *options.surface_m, -kMost, kMost);
  if (options.depth_m) require_range("depth_m", *options.depth_m, 1e-12, kMost);
  return {.force_noise_n = options.force_noise_n,
          .position_noise_m = options.position_noise_m,
          .surface_known = options.surface_m.has_value()};
}

void require_samples(std::span<const double> time_s, std::span<const double> position_m,
                     std::span<const double> force_n) {
  constexpr std::size_t kLeast = 3;
  if (time_s.size() != position_m.size() || time_s.size() != force_n.size() || time_s.size() < kLeast)
    throw InputError("time, position and force have " + std::to_string(time_s.size()) + ", " +
                     std::to_string(position_m.size()) + " and " + std::to_string(force_n.size()) +
                     " samples; these numbers must be equal and at least three");
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (!std::isfinite(time_s[i]) || !std::isfinite(position_m[i]) || !std::isfinite(force_n[i]))
      throw InputError("sample " + std::to_string(i) + " is not finite");
    if (i > 0 && time_s[i] <= time_s[i - 1])
      throw InputError("the time of sample " + std::to_string(i) +
                       " is not later than that of the previous sample");
  }
}

}  // namespace

struct ContactIdentifier::State {
  explicit State(const ContactOptions& o) : options(o), identifier(config_of(o)) {}
  ContactOptions options;
  Identifier identifier;

  /// Evaluates tangent and secant at a depth; none: at the depth of the last sample in contact.
  ContactResult result(std::optional<double> depth_m);
  /// The largest depth on the present object.
  [[nodiscard]] double deepest_m() const { return identifier.visited(1e9); }
};

ContactIdentifier::ContactIdentifier(const ContactOptions& options)
    : state_(std::make_unique<State>(options)) {}
ContactIdentifier::~ContactIdentifier() = default;
ContactIdentifier::ContactIdentifier(ContactIdentifier&&) noexcept = default;
ContactIdentifier& ContactIdentifier::operator=(ContactIdentifier&&) noexcept = default;

void ContactIdentifier::add(double position_m, double velocity_m_per_s, double force_n, double dt_s) {
  state_->identifier.step({.x_m = position_m - state_->options.surface_m.value_or(0.0),
                           .v_m_per_s = velocity_m_per_s,
                           .force_n = force_n},
                          dt_s);
}

void ContactIdentifier::reset() { state_->identifier.begin(); }

ContactResult ContactIdentifier::result_at_deepest() { return state_->result(state_->deepest_m()); }

ContactResult ContactIdentifier::result() { return state_->result(state_->options.depth_m); }

ContactResult ContactIdentifier::State::result(std::optional<double> depth_m) {
  ContactAnswer answer = identifier.answer();
  if (depth_m) answer = identifier.answer_at(*depth_m);
  ContactParameter surface = parameter(answer.surface);
  if (options.surface_m) surface = {*options.surface_m, 0.0, ContactVerdict::kIdentified};
  return {.valid = answer.valid,
          .k = parameter(answer.k),
          .lambda = parameter(answer.lambda),
          .n = parameter(answer.n),
          .tangent = parameter(answer.stiffness),
          .secant = parameter(answer.secant),
          .surface = surface,
          .depth_m = answer.depth_m,
          .force_sd_n = answer.force_sd_n,
          .changes = answer.changes,
          .law_fits = identifier.law_fits()};
}

ContactResult identify(std::span<const double> time_s, std::span<const double> position_m,
                       std::span<const double> force_n, const ContactOptions& options) {
  require_samples(time_s, position_m, force_n);
  ContactIdentifier identifier(options);
  for (std::size_t i = 1; i + 1 < time_s.size(); ++i) {
    const double h1 = time_s[i] - time_s[i - 1], h2 = time_s[i + 1] - time_s[i];
    const double slope1 = (position_m[i] - position_m[i - 1]) / h1;
    const double slope2 = (position_m[i + 1] - position_m[i]) / h2;
    identifier.add(position_m[i], (slope1 * h2 + slope2 * h1) / (h1 + h2), force_n[i], h1);
  }
  if (options.depth_m) return identifier.result();
  return identifier.result_at_deepest();
}

}  // namespace longreach
