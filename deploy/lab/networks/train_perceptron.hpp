#pragma once
// Least squares training of one perceptron: the sum of the squared errors of its three outputs over the
// samples, by Levenberg-Marquardt on all weights together (Ceres Solver, analytic Jacobian, dense normal
// equations, one thread). Deterministic: the same samples and stream give the same bits. Inputs and outputs
// are scaled to [-1, 1]; the returned weights are for radians and are rounded to nine digits, which changes
// the outputs by less than 1e-7.

#include <vector>

#include "common/core/random.hpp"
#include "deploy/lab/networks/spherical_network_config.hpp"

namespace longreach {

struct PerceptronSample {
  Vector3 in, out;
};

/// Throws std::runtime_error if the optimiser fails. It always runs `iterations` iterations.
SphericalPerceptron train_perceptron(const std::vector<PerceptronSample>& samples, int iterations,
                                     Random random);

}  // namespace longreach
