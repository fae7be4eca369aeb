// longreach.identify: the identification of a contact from arrays, without copies.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <span>

#include "deploy/library/include/longreach/error.hpp"
#include "deploy/library/include/longreach/identification.hpp"
#include "deploy/python/bindings.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

using Samples = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::span<const double> span_of(const Samples& samples, const char* name) {
  if (samples.ndim() != 1)
    throw InputError(std::string(name) + " has " + std::to_string(samples.ndim()) +
                     " dimensions instead of 1");
  return {samples.data(), static_cast<std::size_t>(samples.size())};
}

const char* text_of(ContactVerdict verdict) {
  switch (verdict) {
    case ContactVerdict::kTooFewSamples:
      return "too few samples";
    case ContactVerdict::kIdentified:
      return "identified";
    case ContactVerdict::kNotIdentifiable:
      return "not identifiable";
    case ContactVerdict::kNoPowerLaw:
      break;
  }
  return "no power law";
}

py::tuple parameter(const ContactParameter& p) { return py::make_tuple(p.value, p.sd, text_of(p.verdict)); }

py::dict identify_arrays(const Samples& time_s, const Samples& position_m, const Samples& force_n,
                         std::optional<double> surface_m, double force_noise_n, double position_noise_m,
                         std::optional<double> depth_m) {
  const auto t = span_of(time_s, "time"), x = span_of(position_m, "position"), f = span_of(force_n, "force");
  const ContactOptions options{surface_m, force_noise_n, position_noise_m, depth_m};
  const ContactResult r = [&] {
    const py::gil_scoped_release released;
    return identify(t, x, f, options);
  }();
  py::dict all;
  all["valid"] = r.valid;
  all["k"] = parameter(r.k);
  all["lambda_"] = parameter(r.lambda);
  all["n"] = parameter(r.n);
  all["tangent"] = parameter(r.tangent);
  all["secant"] = parameter(r.secant);
  all["surface"] = parameter(r.surface);
  all["depth_m"] = r.depth_m;
  all["force_sd_n"] = r.force_sd_n;
  all["changes"] = r.changes;
  all["law_fits"] = r.law_fits;
  return all;
}

}  // namespace

void bind_contact(py::module_& module) {
  module.def("identify", &identify_arrays, py::arg("time_s"), py::arg("position_m"), py::arg("force_n"),
             py::arg("surface_m"), py::arg("force_noise_n"), py::arg("position_noise_m"), py::arg("depth_m"));
}

}  // namespace longreach
