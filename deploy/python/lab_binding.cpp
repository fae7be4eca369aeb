// longreach.Lab: both sides in virtual time, with parts that may be Python objects.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>

#include "common/messages/conversion.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/touch.hpp"
#include "deploy/library/files.hpp"
#include "deploy/python/bindings.hpp"
#include "deploy/python/python_parts.hpp"
#include "proto/state_master.pb.h"
#include "proto/state_slave.pb.h"

namespace longreach {
namespace {

namespace py = pybind11;

/// The experiment `touch`, stepped from Python.
class PythonLab {
 public:
  PythonLab(const std::vector<std::string>& settings, std::uint64_t seed, py::object law,
            py::object estimator, py::object robot)
      : config_(with_input_errors([&] { return configure(settings, library_files()); })),
        parts_(std::move(law), std::move(estimator), std::move(robot)),
        run_(config_, seed) {
    parts_.set_laboratory(run_.laboratory());
    if (parts_.any()) run_.laboratory().set_fault_hooks(parts_);
  }

  /// Steps up to `ticks` times, at most to the end of the run; returns whether that is reached. Without parts in Python,
  /// other threads of Python run meanwhile.
  bool step(std::int64_t ticks) {
    std::optional<py::gil_scoped_release> released;
    if (!parts_.any()) released.emplace();
    for (std::int64_t i = 0; i < ticks && !run_.done(); ++i) {
      run_.step();
      if (run_.row_is_due()) rows_.push_back(run_.row());
    }
    return run_.done();
  }

  [[nodiscard]] LabState state() const {
    LabState state = state_of(run_.laboratory());
    if (parts_.force_n()) state.force_n = *parts_.force_n();
    return state;
  }
  /// All values of a side as JSON.
  [[nodiscard]] std::string values(const std::string& side) const {
    recording::MasterView master;
    recording::SlaveView slave;
    to_shown_message(run_.laboratory().master(), master);
    to_shown_message(run_.laboratory().slave(), slave);
    const auto tick = static_cast<std::uint64_t>(std::lround(run_.laboratory().now_s() / period_s()));
    master.set_tick(tick);
    slave.set_tick(tick);
    return side == "slave" ? json_object(slave) : json_object(master);
  }
  [[nodiscard]] double completed() const { return run_.completed(); }
  [[nodiscard]] double period_s() const { return run_.laboratory().period_s(); }

  void drive(const Vector3& position_m, const Vector3& velocity_m_per_s, const Vector3& rotation_rad,
             bool held, bool firm) {
    if (!position_m.allFinite() || !velocity_m_per_s.allFinite() || !rotation_rad.allFinite())
      throw InputError("the target of the hand is not finite");
    const Grip grip = !held ? Grip::kReleased : firm ? Grip::kFirm : Grip::kLight;
    run_.laboratory().drive({position_m, velocity_m_per_s, rotation_rad, grip, {}});
  }
  void request(const std::string& what) {
    OperatorRequests& requests = run_.laboratory().requests();
    if (what == "engage") requests.engage = true;
    if (what == "hold") requests.hold = true;
    if (what == "stop") requests.stop = true;
    if (what == "position") requests.mode = MotionMode::kPosition;
    if (what == "rate") requests.mode = MotionMode::kRate;
    if (what == "open") requests.grip = false;
    if (what == "close") requests.grip = true;
  }

  [[nodiscard]] py::dict metrics() const {
    py::dict all;
    for (const Metric& metric : run_.metrics()) all[py::str(metric.name)] = metric.value;
    return all;
  }
  [[nodiscard]] py::dict trace() const {
    py::dict table;
    for (std::size_t column = 0; column < TouchRun::columns().size(); ++column) {
      py::array_t<double> values(static_cast<py::ssize_t>(rows_.size()));
      double* to = values.mutable_data();
      for (const auto& row : rows_) *to++ = row[column];
      table[py::str(std::string(TouchRun::columns()[column]))] = values;
    }
    return table;
  }

 private:
  proto::LabConfig config_;
  PythonParts parts_;
  TouchRun run_;
  std::vector<std::vector<double>> rows_;
};

template <class Class>
void bind_state(Class state) {
  state.def_readonly("time_s", &LabState::time_s)
      .def_readonly("state", &LabState::state)
      .def_readonly("slave_state", &LabState::slave_state)
      .def_readonly("mode", &LabState::mode)
      .def_readonly("scale", &LabState::scale)
      .def_readonly("handle_m", &LabState::handle_m)
      .def_readonly("handle_m_per_s", &LabState::handle_m_per_s)
      .def_readonly("force_n", &LabState::force_n)
      .def_readonly("moment_nm", &LabState::moment_nm)
      .def_readonly("spring_n", &LabState::spring_n)
      .def_readonly("surface_known", &LabState::surface_known)
      .def_readonly("inward", &LabState::inward)
      .def_readonly("surface_m", &LabState::surface_m)
      .def_readonly("stiffness_n_per_m", &LabState::stiffness_n_per_m)
      .def_readonly("goal_m", &LabState::goal_m)
      .def_readonly("X_WE", &LabState::X_WE)
      .def_readonly("anchor_m", &LabState::anchor_m)
      .def_readonly("tool_n", &LabState::tool_n)
      .def_readonly("tool_nm", &LabState::tool_nm)
      .def_readonly("in_contact", &LabState::in_contact)
      .def_readonly("estimate_n_per_m", &LabState::estimate_n_per_m)
      .def_readonly("estimate_sd_n_per_m", &LabState::estimate_sd_n_per_m)
      .def_readonly("reported_n_per_m", &LabState::reported_n_per_m)
      .def_readonly("far_m", &LabState::far_m)
      .def_readonly("far_n", &LabState::far_n)
      .def_readonly("far_contact", &LabState::far_contact)
      .def_readonly("true_n", &LabState::true_n)
      .def_readonly("true_n_per_m", &LabState::true_n_per_m)
      .def_readonly("penetration_m", &LabState::penetration_m)
      .def_readonly("port_energy_j", &LabState::port_energy_j)
      .def_readonly("round_trip_s", &LabState::round_trip_s);
}

}  // namespace

void bind_lab(py::module_& module) {
  bind_state(py::class_<LabState>(module, "LabState"));
  py::class_<PythonLab>(module, "Lab")
      .def(py::init<const std::vector<std::string>&, std::uint64_t, py::object, py::object, py::object>(),
           py::arg("settings"), py::arg("seed"), py::arg("law"), py::arg("estimator"), py::arg("robot"))
      .def("step", &PythonLab::step, py::arg("ticks"))
      .def("state", &PythonLab::state)
      .def("values", &PythonLab::values, py::arg("side"))
      .def("completed", &PythonLab::completed)
      .def("period_s", &PythonLab::period_s)
      .def("drive", &PythonLab::drive, py::arg("position_m"), py::arg("velocity_m_per_s"),
           py::arg("rotation_rad"), py::arg("held"), py::arg("firm"))
      .def("request", &PythonLab::request, py::arg("what"))
      .def("metrics", &PythonLab::metrics)
      .def("trace", &PythonLab::trace);
}

}  // namespace longreach
