#pragma once
// Least-squares training of one perceptron: the sum of squares of its three outputs' errors over the samples,
// by Levenberg-Marquardt on all weights together (Ceres Solver, analytic Jacobian, dense normal equations,
// one thread). Deterministic: the same samples and stream give the same bits. Trained are scaled numbers,
// inputs and outputs in [-1, 1]; the weights that come back take radians and are rounded to nine digits,
// which moves the outputs by less than 1e-7.

#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct PerceptronSample {
  Vector3 in, out;
};

/// Throws std::runtime_error when the optimiser gives up. `iterations` is the bound; there is no other end.
SphericalPerceptron train_perceptron(const std::vector<PerceptronSample>& samples, int iterations,
                                     Random random);

}  // namespace longreach
