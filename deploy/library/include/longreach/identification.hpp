#pragma once
// Identification of a contact from measured motion and force: the Hunt-Crossley law
//   F = k xⁿ + λ xⁿ v,   x: depth behind the surface, v: its derivative
// k, λ, n and the position of the surface are estimated together (maximum likelihood), as in longreach-slave.
// The fit restarts when the tool reaches a different object or layer. Source of the law: K. H. Hunt and F. R.
// E. Crossley, J. Applied Mechanics 42 (1975) 440.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace longreach {

enum class ContactVerdict : std::uint8_t {
  kTooFewSamples,    // more samples or a deeper contact may identify the parameter
  kIdentified,       // standard deviation below 5 % (k, tangent), 0.05 (n), 20 % (λ) or 5/3 % (secant)
  kNotIdentifiable,  // not determined, and more samples of this kind would not help
  kNoPowerLaw        // the force deviates from every power law by more than the noise
};

struct ContactParameter {
  double value = 0.0;
  double sd = 0.0;  // standard deviation
  ContactVerdict verdict = ContactVerdict::kTooFewSamples;
};

struct ContactResult {
  bool valid = false;         // true: there is a fit; false: all values are zero
  ContactParameter k;         // N/mⁿ
  ContactParameter lambda;    // N s/m^(n+1)
  ContactParameter n;         // exponent, 1
  ContactParameter tangent;   // dF/dx of the elastic force at `depth_m`, N/m
  ContactParameter secant;    // elastic force over depth at `depth_m`, N/m
  ContactParameter surface;   // position of the surface, in the coordinates of the samples, m
  double depth_m = 0.0;       // depth of tangent and secant
  double force_sd_n = 0.0;    // standard deviation of a force sample, N
  std::uint32_t changes = 0;  // number of detected changes of the object under the tool
  bool law_fits = true;       // false: no power law explains the force
};

struct ContactOptions {
  std::optional<double> surface_m{};  // position of the surface if it is known, m; otherwise it is identified
  double force_noise_n = 0.0;         // standard deviation; 0: estimated from the samples, N
  double position_noise_m = 0.0;      // standard deviation; 0: estimated from the samples, m
  /// Depth of tangent and secant, m. std::nullopt: for ContactIdentifier::result the depth of the last sample in
  /// contact, for identify() the largest depth.
  std::optional<double> depth_m{};
};

/// Identifies a contact sample by sample, e.g. in a control loop. Does not allocate memory or throw after construction.
class [[gnu::visibility("default")]] ContactIdentifier {
 public:
  /// Throws InputError if an option is not finite, a noise is negative, or depth_m is not positive.
  explicit ContactIdentifier(const ContactOptions& options = {});
  ~ContactIdentifier();
  ContactIdentifier(ContactIdentifier &&) noexcept;
  ContactIdentifier& operator=(ContactIdentifier&&) noexcept;

  /// Adds a sample: position along the inward normal, m; its derivative, m/s; force on the tool along the
  /// outward normal, N; time since the previous sample, s. A sample with a non-finite value is ignored.
  void add(double position_m, double velocity_m_per_s, double force_n, double dt_s);
  /// Discards all samples. Call this when another contact begins.
  void reset();
  [[nodiscard]] ContactResult result();
  /// Same as result(), with tangent and secant at the largest depth on the present object, where the tool pressed
  /// hardest.
  [[nodiscard]] ContactResult result_at_deepest();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Identifies the contact in a recording. The spans have one element per sample: time, s, increasing; position along
/// the inward normal from any fixed point, m; force on the tool along the outward normal, N. Samples before the touch
/// help to find the surface. The velocity is the derivative of the parabola through three samples. Throws InputError
/// if the sizes differ, there are fewer than three samples, a value is not finite, or the time does not increase.
[[gnu::visibility("default")]] ContactResult identify(std::span<const double> time_s,
                                                      std::span<const double> position_m,
                                                      std::span<const double> force_n,
                                                      const ContactOptions& options = {});

}  // namespace longreach
