#include "common/rpc/config_change.hpp"

#include "common/config/ceiling.hpp"
#include "common/config/config.hpp"
#include "common/config/set_fields.hpp"

namespace longreach {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

/// Why a call brings more than one may; empty: it does not.
std::string too_much(const Assignments& assignments) {
  std::size_t bytes = 0;
  for (const auto& [path, value] : assignments) bytes += path.size() + value.size();
  if (assignments.size() <= kAssignmentsMax && bytes <= kAssignmentsMaxBytes) return "";
  return std::to_string(assignments.size()) + " fields and " + std::to_string(bytes) +
         " bytes exceed the limits of one call: " + std::to_string(kAssignmentsMax) + " fields and " +
         std::to_string(kAssignmentsMaxBytes) + " bytes";
}

}  // namespace

std::variant<ConfigChange, Refusal> plan_change(const Configured& config, const Assignments& assignments) {
  if (std::string much = too_much(assignments); !much.empty())
    return Refusal{Refusal::Kind::kInvalid, std::move(much)};
  const google::protobuf::Message& before = config.present;
  ConfigChange change;
  change.after.reset(before.New());
  change.after->CopyFrom(before);
  try {
    set_fields(*change.after, assignments);
  } catch (const ConfigError& e) {
    return Refusal{Refusal::Kind::kInvalid, e.what()};
  }
  if (const auto fixed = refused_changes(before, *change.after, false); !fixed.empty()) {
    return Refusal{Refusal::Kind::kPrecondition,
                   joined(fixed) +
                       " takes effect only at start; set it in the configuration file and "
                       "restart"};
  }
  if (auto beyond = beyond_ceiling(config.start, *change.after))
    return Refusal{Refusal::Kind::kPrecondition, *std::move(beyond)};
  change.not_while_engaged = joined(refused_changes(before, *change.after, true));
  return change;
}

}  // namespace longreach
