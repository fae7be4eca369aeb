#pragma once
// What the estimators of this folder start from, as every recursive least squares starts from a covariance:
// the same as MaximumLikelihood, so that none has an advantage. The data outweigh it within some samples;
// without it, a few samples in a row, which hardly differ, give an exponent and a damping that are far off.

namespace longreach::weak_prior {

inline constexpr double kExponent = 1.75, kExponentSd = 1.0;
inline constexpr double kDampingSd = 10.0;  // of a, s/m; its mean is 0

}  // namespace longreach::weak_prior
