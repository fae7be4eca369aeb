#include "common/io/config_change.hpp"

#include "common/config/ceiling.hpp"
#include "common/config/config.hpp"

namespace longreach {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

}  // namespace

std::variant<ConfigChange, Refusal> plan_change(const SideConfig& config, const Assignments& assignments) {
  const google::protobuf::Message& before = config.present;
  ConfigChange change;
  change.after.reset(before.New());
  change.after->CopyFrom(before);
  try {
    for (const auto& [path, value] : assignments) set_field(*change.after, path, value);
    validate(*change.after);
  } catch (const ConfigError& e) {
    return Refusal{Refusal::Kind::kInvalid, e.what()};
  }
  if (const auto fixed = refused_changes(before, *change.after, false); !fixed.empty()) {
    return Refusal{
        Refusal::Kind::kPrecondition,
        joined(fixed) + " is read once at start; write it into the configuration file and restart"};
  }
  if (auto beyond = beyond_ceiling(config.start, *change.after))
    return Refusal{Refusal::Kind::kPrecondition, *std::move(beyond)};
  change.not_while_engaged = joined(refused_changes(before, *change.after, true));
  return change;
}

}  // namespace longreach
