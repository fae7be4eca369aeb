#pragma once
// Least squares fit of y = φᵀθ with forgetting, in information form: A = Σ w φφᵀ, b = Σ w φ y. The matrix is
// inverted with its diagonal scaled to one, so the units do not matter. A singular A is not detected; its
// solution is not finite.

#include <Eigen/Core>
#include <Eigen/LU>

namespace longreach {

template <int N>
class NormalEquations {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  void add(const Vector& phi, double y, double forgetting) {
    A_ = forgetting * A_ + phi * phi.transpose();
    b_ = forgetting * b_ + phi * y;
  }
  /// Changes the units of the parameters elementwise: θ' = unit θ.
  void rescale(const Vector& unit) {
    const Vector inverse = unit.cwiseInverse();
    A_ = (inverse.asDiagonal() * A_ * inverse.asDiagonal()).eval();
    b_ = inverse.cwiseProduct(b_);
  }
  [[nodiscard]] Matrix inverse() const {
    const Vector scale = A_.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix inner = (scale.asDiagonal() * A_ * scale.asDiagonal()).eval().inverse();
    return scale.asDiagonal() * inner * scale.asDiagonal();
  }
  [[nodiscard]] const Vector& b() const { return b_; }

 private:
  Matrix A_ = Matrix::Zero();
  Vector b_ = Vector::Zero();
};

}  // namespace longreach
