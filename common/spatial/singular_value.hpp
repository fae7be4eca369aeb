#pragma once
// Smallest singular value of a 3x3 matrix: its distance, in the spectral norm, to the nearest singular matrix
// (Eckart, Young 1936). For a matrix of unit rows it lies in [0, 1]: 0 when they are dependent, 1 when they
// are orthogonal. Computed as |det| / (sigma1 sigma2), which keeps its digits near zero. A matrix that is not
// finite gives 0.

#include "common/spatial/spatial.hpp"

namespace longreach {

double smallest_singular_value(const Matrix3& matrix);

}  // namespace longreach
