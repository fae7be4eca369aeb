#pragma once
// Trains one perceptron by least squares: minimises the sum of the squared errors of its three outputs over
// the samples, with Levenberg-Marquardt for all weights simultaneously (Ceres Solver, analytic Jacobian,
// dense normal equations, one thread). The training is deterministic: the same samples and random stream give
// bit-identical weights. Inputs and outputs are scaled to [-1, 1] internally; the returned weights are for
// radians and are rounded to nine digits, which changes the outputs by less than 1e-7.

#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct PerceptronSample {
  Vector3 in, out;
};

/// Always runs `iterations` iterations. Throws std::runtime_error if the optimiser fails.
SphericalPerceptron train_perceptron(const std::vector<PerceptronSample>& samples, int iterations,
                                     Random random);

}  // namespace longreach
