// longreach.Robot: kinematics of an arm, for arrays of joints and poses.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "deploy/library/include/longreach/error.hpp"
#include "deploy/library/include/longreach/robot_arm.hpp"
#include "deploy/python/bindings.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Eigen::VectorXd joints_at(const Array& all, py::ssize_t row) {
  const py::ssize_t size = all.shape(1);
  return Eigen::Map<const Eigen::VectorXd>(all.data() + row * size, size);
}

Eigen::Isometry3d pose_at(const Array& all, py::ssize_t row) {
  constexpr py::ssize_t kNumbers = 16;
  const Eigen::Map<const RowMajor4> X(all.data() + row * kNumbers);
  constexpr double kGiven = 1e-6;
  const Eigen::Matrix3d R = X.topLeftCorner<3, 3>();
  const bool rotation = (R * R.transpose()).isIdentity(kGiven) && R.determinant() > 0.0;
  if (!rotation || !(X.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(kGiven))
    throw InputError("pose " + std::to_string(row) +
                     " is not a rigid transform: 4 x 4, a rotation, and 0 0 0 1");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R;
  pose.translation() = X.topRightCorner<3, 1>();
  return pose;
}

void require_shape(const Array& all, const char* name, std::vector<py::ssize_t> tail) {
  bool right = all.ndim() == static_cast<py::ssize_t>(tail.size()) + 1;
  for (std::size_t i = 0; right && i < tail.size(); ++i)
    right = all.shape(static_cast<py::ssize_t>(i) + 1) == tail[i];
  if (!right) throw InputError(std::string(name) + " has the wrong shape");
}

const char* text_of(ArmStatus status) {
  return status == ArmStatus::kFound ? "found" : status == ArmStatus::kNearest ? "nearest" : "singular";
}

/// All take and return arrays whose first dimension counts the rows; the package adds the other dimensions.
Array forward(const RobotArm& arm, const Array& joints) {
  require_shape(joints, "joints", {static_cast<py::ssize_t>(arm.joints().size())});
  const py::ssize_t rows = joints.shape(0);
  Array result({rows, py::ssize_t{4}, py::ssize_t{4}});
  double* to = result.mutable_data();
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < rows; ++i)
    Eigen::Map<RowMajor4>(to + 16 * i) = arm.forward(joints_at(joints, i)).matrix();
  return result;
}

Array jacobian(const RobotArm& arm, const Array& joints) {
  const auto columns = static_cast<py::ssize_t>(arm.joints().size());
  require_shape(joints, "joints", {columns});
  const py::ssize_t rows = joints.shape(0);
  Array result({rows, py::ssize_t{6}, columns});
  double* to = result.mutable_data();
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < rows; ++i)
    Eigen::Map<Matrix>(to + 6 * columns * i, 6, columns) = arm.jacobian(joints_at(joints, i));
  return result;
}

struct Nearest {
  Array joints;
  std::vector<std::string> status;
  Array position_error_m, rotation_error_rad;
};

Nearest nearest(const RobotArm& arm, const Array& X_WE, const Array& near) {
  const auto columns = static_cast<py::ssize_t>(arm.joints().size());
  require_shape(X_WE, "X_WE", {4, 4});
  require_shape(near, "near", {columns});
  const py::ssize_t rows = X_WE.shape(0);
  if (near.shape(0) != rows) throw InputError("near has the wrong shape");
  Nearest result{Array({rows, columns}), std::vector<std::string>(static_cast<std::size_t>(rows)),
                 Array(rows), Array(rows)};
  double *joints = result.joints.mutable_data(), *position = result.position_error_m.mutable_data(),
         *rotation = result.rotation_error_rad.mutable_data();
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < rows; ++i) {
    const ArmSolution solution = arm.inverse_nearest(pose_at(X_WE, i), joints_at(near, i));
    Eigen::Map<Eigen::VectorXd>(joints + columns * i, columns) = solution.joints;
    result.status[static_cast<std::size_t>(i)] = text_of(solution.status);
    position[i] = solution.position_error_m;
    rotation[i] = solution.rotation_error_rad;
  }
  return result;
}

py::tuple nearest_tuple(const RobotArm& arm, const Array& X_WE, const Array& near) {
  Nearest r = nearest(arm, X_WE, near);
  return py::make_tuple(r.joints, r.status, r.position_error_m, r.rotation_error_rad);
}

std::vector<Array> all(const RobotArm& arm, const Array& X_WE, const Array& near) {
  const auto columns = static_cast<py::ssize_t>(arm.joints().size());
  require_shape(X_WE, "X_WE", {4, 4});
  require_shape(near, "near", {columns});
  std::vector<Array> result;
  for (py::ssize_t i = 0; i < X_WE.shape(0); ++i) {
    const std::vector<Eigen::VectorXd> found = [&] {
      const Eigen::Isometry3d goal = pose_at(X_WE, i);
      const Eigen::VectorXd start = joints_at(near, i);
      const py::gil_scoped_release released;
      return arm.inverse_all(goal, start);
    }();
    Array rows({static_cast<py::ssize_t>(found.size()), columns});
    for (std::size_t k = 0; k < found.size(); ++k)
      Eigen::Map<Eigen::VectorXd>(rows.mutable_data() + columns * static_cast<py::ssize_t>(k), columns) =
          found[k];
    result.push_back(rows);
  }
  return result;
}

py::list joints_of(const RobotArm& arm) {
  py::list all;
  for (const ArmJoint& j : arm.joints())
    all.append(py::make_tuple(j.name, j.prismatic, j.min, j.max, j.speed_max));
  return all;
}

}  // namespace

void bind_robot(py::module_& module) {
  py::class_<RobotArm>(module, "RobotArm")
      .def(py::init([](const std::string& file, const std::string& base_link, const std::string& tip_link) {
             return RobotArm(file, {base_link, tip_link});
           }),
           py::arg("file"), py::arg("base_link"), py::arg("tip_link"))
      .def("name", &RobotArm::name)
      .def("joints", &joints_of)
      .def("start",
           [](const RobotArm& arm) {
             const Eigen::VectorXd start = arm.start();
             return std::vector<double>(start.begin(), start.end());
           })
      .def("inverse_kind", &RobotArm::inverse_kind)
      .def("forward", &forward, py::arg("joints"))
      .def("jacobian", &jacobian, py::arg("joints"))
      .def("nearest", &nearest_tuple, py::arg("X_WE"), py::arg("near"))
      .def("all", &all, py::arg("X_WE"), py::arg("near"));
}

}  // namespace longreach
