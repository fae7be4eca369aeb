#include "common/spatial/singular_value.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace longreach {

double smallest_singular_value(const Matrix3& matrix) {
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (!matrix.allFinite() || scale == 0.0) return 0.0;
  const Matrix3 unit = matrix / scale;
  Eigen::SelfAdjointEigenSolver<Matrix3> squares;
  squares.computeDirect(unit * unit.transpose(), Eigen::EigenvaluesOnly);
  const double product = std::sqrt(squares.eigenvalues()[1]) * std::sqrt(squares.eigenvalues()[2]);
  return product > 0.0 ? scale * std::abs(unit.determinant()) / product : 0.0;
}

}  // namespace longreach
