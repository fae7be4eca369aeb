#pragma once
// Parts of a laboratory that are Python objects: rendering law, estimator and robot. Each object is called in
// the tick of its side, and its result replaces that of the built-in part. The caller must hold the GIL.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>

#include "deploy/lab/fault_hooks.hpp"
#include "deploy/python/lab_state.hpp"

namespace longreach {

class PythonParts : public FaultHooks {
 public:
  /// `None` selects the built-in part.
  PythonParts(pybind11::object law, pybind11::object estimator, pybind11::object robot)
      : law_(std::move(law)), estimator_(std::move(estimator)), robot_(std::move(robot)) {}

  [[nodiscard]] bool any() const { return !law_.is_none() || !estimator_.is_none() || !robot_.is_none(); }
  /// Sets the laboratory that contains these parts. It must outlive them.
  void set_laboratory(const Laboratory& laboratory) { laboratory_ = &laboratory; }

  /// Force of the law on the hand, M, N; std::nullopt if no law is given.
  [[nodiscard]] const std::optional<Vector3>& force_n() const { return force_n_; }

  // Throw std::invalid_argument for a result of the wrong form, and pybind11::error_already_set for a Python exception.
  void robot_reported(Time now, RobotState& reported) override;
  void after_slave_step(SlaveOutput& out) override;
  void after_master_step(MasterOutput& out) override;

 private:
  pybind11::object law_, estimator_, robot_;
  const Laboratory* laboratory_ = nullptr;
  std::optional<Vector3> force_n_{};
  double stiffness_n_per_m_ = 0.0;  // last result of the estimator, N/m; 0: none
};

}  // namespace longreach
