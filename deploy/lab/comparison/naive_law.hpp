#pragma once
// NAIVE: applies stiffness and surface of every report at once, without the passivity rules. This generates energy.
//
//   f = k max(0, s - a),   F = max(0, f + B s') while f > 0

#include <algorithm>

#include "master/config/rendering_config.hpp"
#include "master/rendering/contact_law.hpp"

namespace longreach {

class NaiveLaw final : public ContactLaw {
 public:
  double step(ContactAxis& axis, const ContactHandle& handle, double damping) const override {
    axis.force = axis.reported * std::max(0.0, axis.s(handle.x) - axis.surface);
    return axis.force > 0.0 ? std::max(0.0, axis.force + damping * axis.n_M.dot(handle.rate)) : 0.0;
  }
};

/// Returns the law that a node must render by for `law`; null if it renders by its own springs.
inline const ContactLaw* contact_law(RenderingLaw law) {
  static const NaiveLaw naive;
  return law == RenderingLaw::kNaive ? &naive : nullptr;
}

}  // namespace longreach
