// longreach.Client: one side of a running pair, over gRPC with the certificates of the site.

#include <google/protobuf/util/json_util.h>
#include <pybind11/stl.h>

#include "common/config/config.hpp"
#include "deploy/cli/commands.hpp"
#include "deploy/cli/side_client.hpp"
#include "deploy/python/bindings.hpp"
#include "deploy/python/exceptions.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

std::string json_of(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  (void)google::protobuf::util::MessageToJsonString(message, &text, options);
  return text;
}

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

  std::string status(const std::string& side) { return json_of(client(side).status()); }
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
  std::string mode(const std::string& name) {
    return client("master").set_mode(name == "rate" ? proto::RATE : proto::POSITION);
  }
  std::string scale(double value) { return client("master").set_scale(value); }
  std::string engage() { return client("master").engage(); }
  std::string stop() { return stop_sides(options_); }
  std::string record(const std::string& side, const std::string& name, double max_mb) {
    return client(side).start_recording(name, max_mb);
  }
  std::string stop_recording(const std::string& side) { return client(side).stop_recording(); }

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
      .def("mode", &PythonClient::mode, Release(), py::arg("name"))
      .def("scale", &PythonClient::scale, Release(), py::arg("value"))
      .def("engage", &PythonClient::engage, Release())
      .def("stop", &PythonClient::stop, Release())
      .def("record", &PythonClient::record, Release(), py::arg("side"), py::arg("name"), py::arg("max_mb"))
      .def("stop_recording", &PythonClient::stop_recording, Release(), py::arg("side"));
}

}  // namespace longreach
