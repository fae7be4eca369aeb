// The extension module longreach._longreach. The package longreach is its documentation and its interface.

#include "deploy/library/include/longreach/error.hpp"
#include "deploy/python/bindings.hpp"
#include "deploy/python/exceptions.hpp"

PYBIND11_MODULE(_longreach, module) {
  module.attr("__version__") = longreach::library_version();
  longreach::register_exceptions();
  longreach::bind_lab(module);
  longreach::bind_contact(module);
  longreach::bind_robot(module);
  longreach::bind_client(module);
  longreach::bind_recording(module);
}
