#pragma once
// The sums over all samples that are needed for a least squares fit of F = c0 ξⁿ + c1 ξⁿ v with ξ = x/x_ref,
// for all exponents n at once:
//   S_p(n) = Σ w ξ²ⁿ vᵖ (p = 0, 1, 2),   R_p(n) = Σ w F ξⁿ vᵖ (p = 0, 1)
// They are smooth functions of n, so no linearization about an unknown n is necessary. They are stored either
// on a grid for all n from 0.5 to 3.5, or as a Taylor series about an approximately known n. Raising the weight
// w by a factor of 1/forgetting with each sample discounts older samples without changing the sums. Samples
// with ξ below 0.02 have a negligible weight and are skipped. Depths, forces and speeds must be finite.

#include <array>
#include <cstddef>

#include "slave/estimation/contact_fit.hpp"

namespace longreach {

/// The sums at one n, and their derivatives with respect to n.
struct ExponentSums {
  alignas(16) std::array<std::array<double, 6>, 3> S{};  // [p][order]
  alignas(16) std::array<std::array<double, 4>, 2> R{};
};

/// A sample in the form that the sums use.
struct WeighedSample {
  double log_depth = 0.0;  // ln ξ
  double v_m_per_s = 0.0;
  double force_n = 0.0;  // multiplied by √w
  double root_weight = 1.0;
};

/// Chooses the weights and x_ref, which is within a factor of 2 of the maximum depth.
class SampleScale {
 public:
  struct Change {
    bool counts = false;        // false: the sample is skipped because its depth is too small
    double log_ratio = 0.0;     // ln(previous x_ref/new x_ref); 0: unchanged
    double weight_ratio = 1.0;  // factor by which the stored sums must be multiplied
    WeighedSample sample;
  };
  Change step(const PenetrationSample& sample, double forgetting);

  [[nodiscard]] double reference_m() const { return reference_m_; }
  [[nodiscard]] double weight() const { return root_weight_ * root_weight_; }

 private:
  double reference_m_ = 0.0;  // 0: no sample yet
  double root_weight_ = 1.0;
};

/// The sums at ten nodes, interpolated by the polynomial through them. For n from 1 to 2.5 and ξ from 0.1 to
/// 2 the error is 1e-3.
class ExponentGrid {
 public:
  static constexpr std::size_t kNodes = 10;
  static constexpr double kSpacing = 1.0 / 3.0;
  static double node(std::size_t j) { return 0.5 + kSpacing * static_cast<double>(j); }

  void add(const WeighedSample& sample);
  void rescale(double log_ratio, double weight_ratio);
  /// Returns the sums with derivatives up to `order`, at most 5.
  [[nodiscard]] ExponentSums at(double n, std::size_t order) const;
  /// Returns the sums at a node, without derivatives.
  [[nodiscard]] ExponentSums at_node(std::size_t j) const;

 private:
  using Nodes = std::array<double, kNodes>;
  std::array<Nodes, 3> S_{};
  std::array<Nodes, 2> R_{};
};

/// The sums as a Taylor series about `n0`. The relative error of S at n0 + δ is (2 δ ln ξ)⁶/720; the error of
/// R is smaller.
class ExponentSeries {
 public:
  ExponentSeries() = default;
  ExponentSeries(const ExponentSums& sums, double n0) : sums_(sums), n0_(n0) {}

  /// Adds a sample. Returns the ξⁿ of the sample for an n close to n0.
  double add(const WeighedSample& sample, double n);
  void rescale(double log_ratio, double weight_ratio);
  [[nodiscard]] ExponentSums at(double n) const;
  [[nodiscard]] double n0() const { return n0_; }

 private:
  ExponentSums sums_{};
  double n0_ = 1.0;
};

}  // namespace longreach
