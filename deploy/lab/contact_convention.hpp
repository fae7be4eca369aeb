#pragma once
// Checks that a recording of a contact follows the conventions: t is in s, x is in m from the surface, f has
// no offset, x and f are positive while pressing, and v is the derivative of x. If they are violated, an
// estimator would find no contact or give wrong results. A recording is rejected in these cases:
//   time     the median of the first sample intervals is more than 50 ms (20 Hz): t is in ms, us or ns
//   length   x has no unit, and under force it spans more than 0.2 m or changes by more than 2 m/s:
//            x is in mm or um
//   sign     free space has more than 90 % of the sum of f^2, and |f| grows with -x there (correlation above
//            0.5); or f falls while x grows
//   speed    v has the opposite sign of dx/dt, or differs from it by a factor of 10 or more
//   tare     in free space f is steady and exceeds 5 % of the contact force
//   surface  the force begins beyond 60 % of the maximum x, or exceeds 10 % of its range where x <= 0

#include <array>
#include <optional>
#include <vector>

#include "deploy/lab/contact_table.hpp"

namespace longreach {

class ContactConvention {
 public:
  /// Adds the next row. Throws solve_json::BadRequest if the unit of time does not seem to be s, unless the
  /// recording states the unit (`time_has_unit`).
  void step(const ContactRow& row, bool time_has_unit);
  /// Call this after the last row. Throws a solve_json::BadRequest that names the necessary correction if a
  /// convention is violated.
  void require(bool x_has_unit) const;
  /// True if at least one sample is inside the material.
  [[nodiscard]] bool touches() const { return inside_.n > 0.0; }

 private:
  /// Sums over x and f on one side of the surface.
  struct Sums {
    double n = 0.0, x = 0.0, f = 0.0, xx = 0.0, xf = 0.0, ff = 0.0;
    [[nodiscard]] double correlation() const;
  };
  /// Sums over v and the derivative of x.
  struct Speeds {
    double n = 0.0, vv = 0.0, vg = 0.0, gg = 0.0;
  };
  static constexpr std::size_t kSteps = 4;
  static constexpr std::size_t kKeptMax = 8192;

  void keep(const ContactRow& row);
  void require_signs() const;
  void require_length(double free_n, double force_n) const;
  void require_speed() const;
  void require_tare() const;
  void require_surface(double free_n, double force_n) const;

  Sums outside_, inside_;
  Speeds speeds_;
  std::array<double, kSteps> steps_s_{};
  std::size_t rows_ = 0;
  std::optional<ContactRow> last_{};
  std::vector<ContactRow> kept_;  // every `stride_`-th row
  std::size_t stride_ = 1;
};

}  // namespace longreach
