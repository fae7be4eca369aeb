#include "deploy/lab/networks/spherical_network_file.hpp"

#include <google/protobuf/message.h>

#include <optional>

#include "common/config/config.hpp"
#include "common/config/field_path.hpp"
#include "common/text/number_text.hpp"
#include "proto/network.pb.h"

namespace longreach {
namespace {

using google::protobuf::Message;
constexpr int kUnits = SphericalPerceptron::kUnits;

/// Returns the first missing field. All fields are required, because a network has no defaults.
std::optional<FieldPath> absent(const Message& message) {
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const auto* field = message.GetDescriptor()->field(i);
    const auto& reflection = *message.GetReflection();
    const int size = field->is_repeated() ? reflection.FieldSize(message, field) : -1;
    if (size == 0 || (size < 0 && !reflection.HasField(message, field))) return FieldPath{{field, -1}};
    if (!holds_messages(*field)) continue;
    for (int index = size < 0 ? -1 : 0; index < size || index < 0; ++index) {
      const PathStep step{field, index};
      if (auto path = absent(message_at(message, step))) {
        path->insert(path->begin(), step);
        return path;
      }
      if (index < 0) break;
    }
  }
  return std::nullopt;
}

template <class Numbers>
Vector3 vector(const Numbers& three) {
  return {three[0], three[1], three[2]};
}

SphericalPerceptron to_struct(const proto::SphericalPerceptron& message) {
  SphericalPerceptron net;
  for (int u = 0; u < kUnits; ++u) {
    const auto& unit = message.unit(u);
    const auto n = static_cast<std::size_t>(u);
    net.bias[n] = unit.bias();
    for (int i = 0; i < 3; ++i) {
      net.in[static_cast<std::size_t>(i)][n] = unit.in(i);
      net.out[static_cast<std::size_t>(i)][n] = unit.out(i);
    }
  }
  for (int i = 0; i < 3; ++i) net.offset[static_cast<std::size_t>(i)] = message.offset(i);
  return net;
}

SphericalNetworkConfig to_struct(const proto::SphericalNetwork& message) {
  SphericalNetworkConfig c;
  c.axes.alpha1 = message.geometry().alpha1_rad();
  c.axes.alpha2 = message.geometry().alpha2_rad();
  for (int i = 0; i < 3; ++i) {
    const auto& leg = message.geometry().leg(i);
    c.axes.u.row(i) = vector(leg.base_axis());
    c.axes.w0.row(i) = vector(leg.middle_axis());
    c.axes.v.row(i) = vector(leg.platform_axis());
  }
  const auto& w = message.workspace();
  c.workspace = {vector(w.home_rad()), Quaternion(w.q_home(0), w.q_home(1), w.q_home(2), w.q_home(3)),
                 w.common_rad(), w.differential_rad()};
  const auto& cells = message.cells();
  c.cells = {static_cast<int>(cells.per_axis()), vector(cells.width()), cells.overlap()};
  c.rough = to_struct(message.rough());
  for (const auto& net : message.fine()) c.fine.push_back(to_struct(net));
  return c;
}

/// "NAME: [a, b, c]".
std::string list(const std::string& name, std::initializer_list<double> numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ", ") + format_number(x);
  return name + ": [" + text + "]";
}
std::string list(const std::string& name, const Vector3& v) { return list(name, {v.x(), v.y(), v.z()}); }
std::string number(const std::string& name, double value) { return name + ": " + format_number(value); }

std::string text_of(const std::string& name, const SphericalPerceptron& net) {
  std::string text = name + " {\n";
  for (std::size_t u = 0; u < kUnits; ++u) {
    text += "  unit { " + list("in", {net.in[0][u], net.in[1][u], net.in[2][u]}) + " " +
            number("bias", net.bias[u]) + " " + list("out", {net.out[0][u], net.out[1][u], net.out[2][u]}) +
            " }\n";
  }
  return text + "  " + list("offset", {net.offset[0], net.offset[1], net.offset[2]}) + "\n}\n";
}

}  // namespace

SphericalNetworkFile load_spherical_network(const std::filesystem::path& file) {
  proto::SphericalNetwork message;
  load_text_file(file, message);
  if (const auto path = absent(message))
    throw ConfigError(file.string() + ": " + path_text(message, *path) + " is missing");
  const auto n = message.cells().per_axis();
  if (static_cast<unsigned>(message.fine_size()) != n * n * n) {
    throw ConfigError(file.string() + ": fine occurs " + std::to_string(message.fine_size()) +
                      " times, but cells.per_axis = " + std::to_string(n) + " requires " +
                      std::to_string(n * n * n));
  }
  return {message.name(), to_struct(message), message.error_max_rad(), message.error_rms_rad()};
}

std::string spherical_network_text(const SphericalNetworkFile& network, const std::string& comment) {
  const SphericalNetworkConfig& c = network.config;
  std::string text = comment + "name: \"" + network.name + "\"\n";
  text += "geometry {\n  " + number("alpha1_rad", c.axes.alpha1) + "\n  " +
          number("alpha2_rad", c.axes.alpha2) + "\n";
  for (int i = 0; i < 3; ++i) {
    text += "  leg {\n    " + list("base_axis", c.axes.u.row(i)) + "\n    " +
            list("middle_axis", c.axes.w0.row(i)) + "\n    " + list("platform_axis", c.axes.v.row(i)) +
            "\n  }\n";
  }
  const SphericalWorkspace& w = c.workspace;
  const Quaternion& q = w.q_home;
  text += "}\nworkspace {\n  " + list("home_rad", w.home_rad) + "\n  " +
          list("q_home", {q.w(), q.x(), q.y(), q.z()}) + "\n  " + number("common_rad", w.common_rad) +
          "\n  " + number("differential_rad", w.differential_rad) + "\n}\n";
  text += "cells {\n  per_axis: " + std::to_string(c.cells.per_axis) + "\n  " + list("width", c.cells.width) +
          "\n  " + number("overlap", c.cells.overlap) + "\n}\n";
  text += number("error_max_rad", network.error_max_rad) + "\n" +
          number("error_rms_rad", network.error_rms_rad) + "\n" + text_of("rough", c.rough);
  for (const SphericalPerceptron& net : c.fine) text += text_of("fine", net);
  return text;
}

}  // namespace longreach
