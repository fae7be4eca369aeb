// longreach.Client: one side of a running pair, over gRPC with the certificates of the site.

#include <google/protobuf/util/json_util.h>
#include <pybind11/stl.h>

#include "common/config/config.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/json_text.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/library/include/longreach/error.hpp"
#include "deploy/python/bindings.hpp"
#include "deploy/python/exceptions.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

Side side_of(const std::string& name) { return name == "slave" ? Side::kSlave : Side::kMaster; }

/// All calls share one connection to each side. Other threads of Python run during a call.
class PythonClient {
 public:
  PythonClient(std::string master, std::string slave, std::optional<double> timeout_s, std::string site,
               bool insecure)
      : options_{std::move(master),
                 std::move(slave),
                 timeout_s,
                 false,
                 std::move(site),
                 insecure,
                 std::make_shared<RpcConnections>()} {}

  std::string status(const std::string& side) { return json_object(client(side).status()); }
  std::string get(const std::string& side, const std::string& path, bool origin) {
    return client(side).get(path, origin);
  }
  std::string set(const std::string& side, const std::vector<std::pair<std::string, std::string>>& fields) {
    return client(side).set(fields);
  }
  std::string set_link(const std::string& direction, const std::optional<std::string>& profile,
                       const std::vector<std::pair<std::string, std::string>>& fields) {
    LinkSetCommand command;
    command.direction = direction == "up"     ? Direction::kUp
                        : direction == "down" ? Direction::kDown
                                              : Direction::kBoth;
    command.profile = profile;
    for (const auto& [path, value] : fields) set_field(command.fields, path, value);
    return longreach::set_link(options_, command);
  }
  /// `action` is an Action of proto/control.proto as JSON.
  std::string run(const std::string& side, const std::string& action) {
    proto::Action parsed;
    const auto status = google::protobuf::util::JsonStringToMessage(action, &parsed);
    if (!status.ok()) throw InputError("the action is not one of proto/control.proto: " + status.ToString());
    return client(side).run(parsed);
  }
  std::string stop() { return stop_sides(options_); }

 private:
  SideClient client(const std::string& side) { return {side_of(side), options_}; }
  Options options_;
};

}  // namespace

void bind_client(py::module_& module) {
  using Release = py::call_guard<py::gil_scoped_release>;
  py::class_<PythonClient>(module, "Client")
      .def(py::init<std::string, std::string, std::optional<double>, std::string, bool>(), py::arg("master"),
           py::arg("slave"), py::arg("timeout_s"), py::arg("site"), py::arg("insecure"))
      .def("status", &PythonClient::status, Release(), py::arg("side"))
      .def("get", &PythonClient::get, Release(), py::arg("side"), py::arg("path"), py::arg("origin"))
      .def("set", &PythonClient::set, Release(), py::arg("side"), py::arg("fields"))
      .def("set_link", &PythonClient::set_link, Release(), py::arg("direction"), py::arg("profile"),
           py::arg("fields"))
      .def("run", &PythonClient::run, Release(), py::arg("side"), py::arg("action"))
      .def("stop", &PythonClient::stop, Release());
}

}  // namespace longreach
