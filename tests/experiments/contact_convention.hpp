#pragma once
// Whether a recording of a contact keeps to the convention: t in s, x and f positive while pressing. A wrong
// unit or sign is no contact to an estimator, which would answer "not yet" for ever.
//   time  samples further apart than 50 ms (20 Hz, by the median of the first) are taken for ms, us or ns
//   sign  more than 90 % of the sum of f^2 is in free space and grows with -x (correlation of |f| above 0.5),
//         or f falls while x grows

#include <array>

#include "tests/experiments/contact_table.hpp"

namespace longreach {

class ContactConvention {
 public:
  /// Throws solve_json::BadRequest when the unit of time is not s; not with `time_has_unit`.
  void step(const ContactRow& row, bool time_has_unit);
  /// After the last row. Throws solve_json::BadRequest when the press is counted negative.
  void require_signs() const;

 private:
  /// Of x and f on one side of the surface.
  struct Sums {
    double n = 0.0, x = 0.0, f = 0.0, xx = 0.0, xf = 0.0, ff = 0.0;
    [[nodiscard]] double correlation() const;
  };
  static constexpr std::size_t kSteps = 4;

  Sums outside_, inside_;
  std::array<double, kSteps> steps_s_{};
  std::size_t rows_ = 0;
  double last_t_s_ = 0.0;
};

}  // namespace longreach
