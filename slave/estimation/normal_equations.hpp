#pragma once
// Least squares of y = φᵀθ with forgetting, in information form: A = Σ w φφᵀ, b = Σ w φ y. Solved with the
// diagonal scaled to one, so that units do not matter. Not handled: a singular A, whose solution is not
// finite.

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
  /// Changes the units of the parameters: θ' = unit θ, elementwise.
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
