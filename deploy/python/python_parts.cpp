#include "deploy/python/python_parts.hpp"

#include <pybind11/numpy.h>

#include <stdexcept>
#include <string>

namespace longreach {
namespace {

namespace py = pybind11;

[[noreturn]] void wrong_form(const std::string& method, const std::string& expected,
                             const py::handle& result) {
  throw std::invalid_argument(method + " returned " + std::string(py::repr(result)) + ", which is not " +
                              expected);
}

/// The elements of a sequence or array as a vector of fixed size.
template <int Size>
Eigen::Matrix<double, Size, 1> vector_of(const py::handle& value, const std::string& method,
                                         const std::string& expected) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    wrong_form(method, expected, value);
  }
  if (array.ndim() != 1 || array.shape(0) != Size) wrong_form(method, expected, value);
  const Eigen::Map<const Eigen::Matrix<double, Size, 1>> result(array.data());
  if (!result.allFinite()) wrong_form(method, expected + " of finite numbers", value);
  return result;
}

}  // namespace

void PythonParts::robot_reported(Time /*now*/, RobotState& reported) {
  if (robot_.is_none()) return;
  const std::string method = "robot.step()";
  const std::string form = "(joints, speeds, force, moment) with 6, 6, 3 and 3 numbers";
  const auto& setpoint = laboratory_->setpoint_rad();
  const py::object result = robot_.attr("step")(
      laboratory_->now_s(), setpoint ? py::cast(JointVector(*setpoint)) : py::object(py::none()));
  if (!py::isinstance<py::sequence>(result) || py::len(result) != 4) wrong_form(method, form, result);
  const auto parts = py::reinterpret_borrow<py::sequence>(result);
  reported.joint_rad = vector_of<kMaxJoints>(parts[0], method, form);
  reported.joint_rad_per_s = vector_of<kMaxJoints>(parts[1], method, form);
  reported.F_F_W.force = vector_of<3>(parts[2], method, form);
  reported.F_F_W.moment = vector_of<3>(parts[3], method, form);
}

void PythonParts::after_slave_step(SlaveOutput& out) {
  if (estimator_.is_none()) return;
  if (!laboratory_->slave().in_contact) {
    stiffness_n_per_m_ = 0.0;
    return;
  }
  const py::object result = estimator_.attr("stiffness")(state_of(*laboratory_));
  if (!result.is_none()) {
    if (PyNumber_Check(result.ptr()) == 0) wrong_form("estimator.stiffness()", "a number or None", result);
    const double stiffness = py::float_(result);
    if (!(stiffness >= 0.0 && stiffness <= kStiffnessMaxNPerM))
      wrong_form("estimator.stiffness()", "a stiffness from 0 to 1e12 N/m", result);
    stiffness_n_per_m_ = stiffness;
  }
  if (!out.report) return;
  for (ReportedSurface& surface : out.report->translation.surfaces) {
    if (!surface.pressed) continue;
    surface.stiffness = stiffness_n_per_m_;
    surface.foot = 0.0;  // a linear spring from the surface
  }
}

void PythonParts::after_master_step(MasterOutput& out) {
  if (law_.is_none()) return;
  const py::object result = law_.attr("force")(state_of(*laboratory_));
  force_n_ = vector_of<3>(result, "law.force()", "a force with 3 numbers");
  out.F_H_M.force = *force_n_;
}

}  // namespace longreach
