#pragma once
// Checks that a recording of a contact follows the conventions: t in s, x in m from the surface, f without an
// offset, x and f positive while pressing, v the derivative of x. Otherwise an estimator would find no
// contact or give wrong results.
//   time     sample intervals over 50 ms (20 Hz, median of the first samples) indicate ms, us or ns
//   length   x without a unit that spans more than 0.2 m under force, or grows by more than 2 m/s there,
//            indicates mm or um
//   sign     more than 90 % of the sum of f^2 is in free space and grows with -x (correlation of |f| above
//            0.5), or f falls while x grows
//   speed    v falls as x grows, or is 10 times its growth or more, or a tenth or less
//   tare     in free space f is steady and above 5 % of the force of the contact
//   surface  the force begins beyond 60 % of the maximum x, or grows above 10 % in front of x = 0

#include <array>
#include <optional>
#include <vector>

#include "deploy/lab/contact_table.hpp"

namespace longreach {

class ContactConvention {
 public:
  /// Adds the next row. Throws solve_json::BadRequest if the unit of time seems to be another than s, unless
  /// the recording states it (`time_has_unit`).
  void step(const ContactRow& row, bool time_has_unit);
  /// Call it after the last row. Throws a solve_json::BadRequest that names the necessary correction if a
  /// convention is violated.
  void require(bool x_has_unit) const;
  /// True if at least one sample is behind the surface.
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
