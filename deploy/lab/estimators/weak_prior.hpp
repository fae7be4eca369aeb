#pragma once
// The prior of the estimators in this folder, which corresponds to the initial covariance of recursive least
// squares. It is the same as the prior of MaximumLikelihood, so that no estimator has an advantage. After a
// few samples, the data outweigh the prior. Without a prior, a few similar samples would give a very
// inaccurate exponent and damping.

namespace longreach::weak_prior {

inline constexpr double kExponent = 1.75, kExponentSd = 1.0;
inline constexpr double kDampingSd = 10.0;  // prior standard deviation of a, s/m; the prior mean of a is 0

}  // namespace longreach::weak_prior
