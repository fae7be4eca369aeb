// The configuration: every number with a range, in every message of both sides, at what it must not be; and
// directions that point nowhere.

#include <algorithm>
#include <limits>

#include "common/config/config.hpp"
#include "common/config/field_path.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "tests/extremes/extremes.hpp"

namespace longreach {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Calls `visit` for every number of `message` that has a range; lists get an element.
template <class Visit>
void visit_numbers(Message& root, Message& message, FieldPath& path, const Visit& visit) {
  const Descriptor& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    const auto* reflection = message.GetReflection();
    path.push_back({field, field->is_repeated() ? 0 : -1});
    if (holds_messages(*field)) {
      const auto count = static_cast<int>(field->options().GetExtension(proto::count));
      while (field->is_repeated() && reflection->FieldSize(message, field) < std::max(1, count))
        reflection->AddMessage(&message, field);
      visit_numbers(root, mutable_message_at(message, path.back()), path, visit);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && !field->is_repeated() &&
               field->options().HasExtension(proto::range)) {
      visit(path_text(root, path), field->options().GetExtension(proto::range));
    }
    path.pop_back();
  }
}

/// Sets every number in turn to what `value` makes of its range: each has to be refused by name.
ExtremeResult refuse_all(const std::function<double(const proto::Range&)>& value) {
  proto::LabConfig config;
  FieldPath path;
  int refusals = 0, fields = 0;
  std::string taken, first;
  visit_numbers(config, config, path, [&](const std::string& field, const proto::Range& range) {
    ++fields;
    proto::LabConfig one = config;
    try {
      set_field(one, field, format_number(value(range)));
      taken = field + " is taken";
    } catch (const ConfigError& e) {
      const std::string why = e.what();
      if (first.empty()) first = why;
      if (why.starts_with(field))
        ++refusals;
      else
        taken = why;
    }
  });
  if (fields == 0 || refusals != fields)
    return bad(taken + "; " + std::to_string(refusals) + " of " + std::to_string(fields) + " refused");
  return refused("all " + std::to_string(fields) + ", e.g. " + first);
}

ExtremeCell setting(const std::string& name, const std::string& path, const std::string& value,
                    const std::string& refusal) {
  return {name, refusal, [=](std::uint64_t) {
            static_cast<void>(configure({path + "=" + value}, find_deploy_folder()));
            return bad(path + " = " + value + " is taken");
          }};
}

}  // namespace

std::vector<ExtremeRow> extreme_settings() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto all = [](const std::string& name, const std::function<double(const proto::Range&)>& value,
                      const std::string& refusal = "outside") {
    return ExtremeCell{name, refusal, [value](std::uint64_t) { return refuse_all(value); }};
  };
  ExtremeRow numbers{
      "configuration: every number with a range",
      "refused, each by its name",
      all("in the middle", [](const proto::Range& r) { return 0.5 * (r.min() + r.max()); }),
      {all(
           "NaN", [](const auto&) { return std::numeric_limits<double>::quiet_NaN(); }, "finite"),
       all(
           "inf", [](const auto&) { return inf; }, "finite"),
       all(
           "-inf", [](const auto&) { return -inf; }, "finite"),
       all("1e300", [](const auto&) { return 1e300; }),
       all("above max",
           [](const proto::Range& r) { return r.max() + 1e-3 * std::max(1e-3, std::abs(r.max())); }),
       all("below min",
           [](const proto::Range& r) { return r.min() - 1e-3 * std::max(1e-3, std::abs(r.min())); })}};
  ExtremeRow nothing{"configuration: directions and shapes of nothing",
                     "refused with the reason",
                     setting("one that is right", "scene.surface.0.plane.normal", "0,0,1",
                             "does not define "
                             "a direction"),
                     {setting("normal 0", "scene.surface.0.plane.normal", "0,0,0",
                              "does not define a "
                              "direction"),
                      setting("n 1e-200", "scene.surface.0.plane.normal", "1e-200,0,0",
                              "does not define a "
                              "direction"),
                      setting("operator 0", "operator.direction", "0,0,0", "does not define a direction"),
                      setting("k = 0", "scene.material.0.stiffness_n_per_m", "0", "outside 0 (excluded)"),
                      setting("k = 1.1e9", "scene.material.0.stiffness_n_per_m", "1.1e9", "to 1e9"),
                      setting("n = 0.9", "scene.material.0.exponent", "0.9", "outside 1 to 3"),
                      setting("n = 3.1", "scene.material.0.exponent", "3.1", "outside 1 to 3"),
                      setting("rows of 0", "slave.robot.joint.1.a_m", "0", "rotate about the same axis")}};
  return {numbers, nothing};
}

}  // namespace longreach
