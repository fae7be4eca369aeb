#pragma once
// Smallest singular value of a 3x3 matrix, which is its distance to the nearest singular matrix in the
// spectral norm (Eckart, Young 1936). For a matrix with unit rows it is in [0, 1]: 0 if the rows are linearly
// dependent, 1 if they are orthogonal. It is computed as |det| / (sigma1 sigma2), which is accurate even near
// zero. If the matrix is not finite, the result is 0.

#include "common/spatial/spatial.hpp"

namespace longreach {

double smallest_singular_value(const Matrix3& matrix);

}  // namespace longreach
