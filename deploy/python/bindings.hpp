#pragma once
// The parts of the extension module longreach._longreach. The package longreach wraps them and adds
// documentation, type hints and default values.

#include <pybind11/pybind11.h>

namespace longreach {

void bind_lab(pybind11::module_& module);
void bind_contact(pybind11::module_& module);
void bind_robot(pybind11::module_& module);
void bind_client(pybind11::module_& module);
void bind_recording(pybind11::module_& module);

}  // namespace longreach
