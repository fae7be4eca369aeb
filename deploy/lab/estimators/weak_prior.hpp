#pragma once
// The prior of the estimators of this folder, like the initial covariance of every recursive least squares:
// the same as for MaximumLikelihood, so that none has an advantage. The data outweigh it within some samples;
// without it, a few similar samples would give a very inaccurate exponent and damping.

namespace longreach::weak_prior {

inline constexpr double kExponent = 1.75, kExponentSd = 1.0;
inline constexpr double kDampingSd = 10.0;  // of a, s/m; its mean is 0

}  // namespace longreach::weak_prior
