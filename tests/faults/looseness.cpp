#include "tests/faults/looseness.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <stdexcept>
#include <vector>

namespace longreach {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr double kAutomaticGap_s = 0.1;

constexpr GuardedField kSlave[] = {
    {"command.speed_max_m_per_s", Loose::kAbove},
    {"command.acceleration_max_m_per_s2", Loose::kOther},
    {"command.speed_max_rad_per_s", Loose::kAbove},
    {"command.acceleration_max_rad_per_s2", Loose::kOther},
    {"command.force_guard_n", Loose::kAbove},
    {"command.guard_stiffness_n_per_m", Loose::kOther},
    {"command.workspace_m", Loose::kOther},
    {"command.tolerance_m", Loose::kOther},
    {"command.iterations_max", Loose::kOther},
    {"command.hold_force_n", Loose::kOther},
    {"command.moment_guard_nm", Loose::kAbove},
    {"command.give_way_m", Loose::kAbove},
    {"command.braking_max_m_per_s2", Loose::kOther},
    {"sensing.force_noise_n", Loose::kOther},
    {"sensing.moment_noise_nm", Loose::kOther},
    {"sensing.touch_n", Loose::kOther},
    {"sensing.release_n", Loose::kOther},
    {"sensing.filter_s", Loose::kOther},
    {"sensing.force_bias_n", Loose::kOther},
    {"sensing.moment_bias_nm", Loose::kOther},
    {"sensing.force_drift_n", Loose::kOther},
    {"sensing.moment_drift_nm", Loose::kOther},
    {"sensing.force_resolution_n", Loose::kOther},
    {"sensing.moment_resolution_nm", Loose::kOther},
    {"sensing.force_range_n", Loose::kOther},
    {"sensing.moment_range_nm", Loose::kOther},
    {"sensing.bandwidth_hz", Loose::kOther},
    {"sensing.tool.mass_kg", Loose::kOther},
    {"sensing.tool.com_m", Loose::kOther},
    {"sensing.tool.inertia_kg_m2", Loose::kOther},
    {"sensing.gravity_m_per_s2", Loose::kOther},
    {"sensing.zero_s", Loose::kOther},
    {"sensing.touch_nm", Loose::kOther},
    {"sensing.release_nm", Loose::kOther},
    {"sensing.force", Loose::kOther},
    {"sensing.moment", Loose::kOther},
    {"safety.gap_s", Loose::kAbove, kAutomaticGap_s},
    {"safety.age_max_s", Loose::kAbove},
    {"safety.resume_s", Loose::kAbove},
    {"safety.delay_rise_max_s", Loose::kAbove},
    {"playout.fixed_delay_s", Loose::kAbove},
    {"playout.delay_max_s", Loose::kAbove},
};

constexpr GuardedField kMaster[] = {
    {"rendering.law", Loose::kOther},
    {"rendering.ke", Loose::kAbove},
    {"rendering.contact_damping_n_s_per_m", Loose::kOther},
    {"rendering.stiffness_max_n_per_m", Loose::kAbove},
    {"rendering.fade_s", Loose::kAbove},
    {"rendering.tank_max_j", Loose::kAbove},
    {"rendering.store_j", Loose::kAbove},
    {"rendering.rate_stiffness_n_per_m", Loose::kAbove},
    {"rendering.rate_damping_n_s_per_m", Loose::kOther},
    {"rendering.friction_n", Loose::kAbove},
    {"rendering.friction_stiffness_n_per_m", Loose::kAbove},
    {"rendering.rotational_stiffness_nm_per_rad", Loose::kAbove},
    {"rendering.rotational_damping_nm_s_per_rad", Loose::kOther},
    {"rendering.force_max_n", Loose::kAbove},
    {"rendering.moment_max_nm", Loose::kAbove},
    {"rendering.ramp_s", Loose::kAbove},
    {"rendering.ke_rotation", Loose::kAbove},
    {"rendering.contact_damping_nm_s_per_rad", Loose::kOther},
    {"rendering.stiffness_max_nm_per_rad", Loose::kAbove},
    {"rendering.registration", Loose::kOther},
    {"rendering.slew_n_per_s", Loose::kAbove},
    {"rendering.slew_nm_per_s", Loose::kAbove},
    {"rendering.load_factor", Loose::kAbove},
    {"rendering.rate_force_ratio", Loose::kAbove},
    {"rendering.friction_nm", Loose::kAbove},
    {"rendering.friction_stiffness_nm_per_rad", Loose::kAbove},
    {"rendering.home_spring", Loose::kOther},
    {"rendering.ke_by_scale", Loose::kOther},
    {"safety.silence_s", Loose::kAbove},
    {"safety.resume_s", Loose::kAbove},
    {"safety.engage_at_start", Loose::kOther},
    {"safety.presence", Loose::kBelow},
    {"safety.presence_s", Loose::kAbove},
    {"safety.gap_s", Loose::kAbove, kAutomaticGap_s},
    {"safety.delay_rise_max_s", Loose::kAbove},
};

double number(const Message& m, const FieldDescriptor& f) {
  const auto& reflection = *m.GetReflection();
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(m, &f);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(m, &f);
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(m, &f) ? 1.0 : 0.0;
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnumValue(m, &f);
    default:
      throw std::logic_error("no number: " + f.full_name());
  }
}

/// The number or numbers at a path; throws std::logic_error where there are none.
std::vector<double> values(const Message& m, std::string_view path) {
  const std::size_t dot = path.find('.');
  const FieldDescriptor* field = m.GetDescriptor()->FindFieldByName(std::string(path.substr(0, dot)));
  if (field == nullptr) throw std::logic_error("no field " + std::string(path));
  if (dot != std::string_view::npos)
    return values(m.GetReflection()->GetMessage(m, field), path.substr(dot + 1));
  if (!field->is_repeated()) return {number(m, *field)};
  std::vector<double> all;
  for (int i = 0; i < m.GetReflection()->FieldSize(m, field); ++i)
    all.push_back(m.GetReflection()->GetRepeatedDouble(m, field, i));
  return all;
}

bool is_looser(const GuardedField& limit, const Message& start, const Message& now) {
  const std::vector<double> before = values(start, limit.path), after = values(now, limit.path);
  const auto stands_for = [&](double value) { return value == 0.0 ? limit.automatic : value; };
  switch (limit.looser) {
    case Loose::kAbove:
      return !(stands_for(after.front()) <= stands_for(before.front()));
    case Loose::kBelow:
      return !(after.front() >= before.front());
    case Loose::kOther:
      break;
  }
  return before != after;
}

std::string first_looser(std::span<const GuardedField> limits, const Message& start, const Message& now) {
  for (const GuardedField& limit : limits)
    if (is_looser(limit, start, now))
      return std::string(limit.path) +
             " is less restrictive than at the "
             "start";
  return {};
}

}  // namespace

std::span<const GuardedField> slave_limits() { return kSlave; }
std::span<const GuardedField> master_limits() { return kMaster; }

std::string looser(const proto::SlaveConfig& start, const proto::SlaveConfig& now) {
  return first_looser(kSlave, start, now);
}
std::string looser(const proto::MasterConfig& start, const proto::MasterConfig& now) {
  return first_looser(kMaster, start, now);
}

}  // namespace longreach
