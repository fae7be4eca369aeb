#pragma once
// Parts of a laboratory that are Python objects: rendering law, estimator and robot. Each is called in the tick of its side,
// and its result replaces that of the project's own part. The GIL must be held.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

#include "deploy/lab/fault_hooks.hpp"
#include "deploy/python/lab_state.hpp"

namespace longreach {

class PythonParts : public FaultHooks {
 public:
  /// None: the project's own part.
  PythonParts(pybind11::object law, pybind11::object estimator, pybind11::object robot)
      : law_(std::move(law)), estimator_(std::move(estimator)), robot_(std::move(robot)) {}

  [[nodiscard]] bool any() const { return !law_.is_none() || !estimator_.is_none() || !robot_.is_none(); }
  /// The laboratory that they are part of. It must outlive them.
  void set_laboratory(const Laboratory& laboratory) { laboratory_ = &laboratory; }

  // Throw std::invalid_argument if a result has the wrong form, pybind11::error_already_set for an exception of Python.
  /// Force of the law on the hand, M, N; none without a law.
  [[nodiscard]] const std::optional<Vector3>& force_n() const { return force_n_; }

  void robot_reported(RobotState& reported) override;
  void after_slave_step(SlaveOutput& out) override;
  void after_master_step(MasterOutput& out) override;

 private:
  pybind11::object law_, estimator_, robot_;
  const Laboratory* laboratory_ = nullptr;
  std::optional<Vector3> force_n_{};
  double stiffness_n_per_m_ = 0.0;  // last result of the estimator; 0: none
};

}  // namespace longreach
