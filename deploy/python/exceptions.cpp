#include "deploy/python/exceptions.hpp"

#include <pybind11/pybind11.h>

#include "common/config/config.hpp"
#include "common/recording/recording_error.hpp"
#include "common/site/site.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/library/include/longreach/error.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

void raise(const char* name, const char* sentence) {
  const py::object type = py::module_::import("longreach.errors").attr(name);
  PyErr_SetString(type.ptr(), sentence);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise("InputError", error.what());
  } catch (const ConfigError& error) {
    raise("InputError", error.what());
  } catch (const UsageError& error) {
    raise("InputError", error.what());
  } catch (const RecordingError& error) {
    raise("RecordingError", error.what());
  } catch (const SiteError& error) {
    raise("NotReachable", error.what());
  } catch (const SideError& error) {
    raise(error.kind() == SideError::Kind::kBadValue  ? "InputError"
          : error.kind() == SideError::Kind::kRefused ? "Refused"
                                                      : "NotReachable",
          error.what());
  } catch (const std::invalid_argument& error) {
    raise("InputError", error.what());
  }
}

}  // namespace

void register_exceptions() { py::register_exception_translator(&translate); }

}  // namespace longreach
