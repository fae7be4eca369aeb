// A setting of a laboratory run, whose path may leave out the side.

#include <algorithm>

#include "common/config/config.hpp"
#include "common/config/violation.hpp"

namespace longreach {
namespace {

struct Candidate {
  std::string path;
  PathLookup found;
  std::size_t depth = 0;  // steps that were found beyond the prefix
};

Candidate candidate(const proto::LabConfig& config, const std::string& prefix, std::string_view path) {
  Candidate result{prefix + std::string(path), {}, 0};
  result.found = find_path(config, result.path);
  result.depth = result.found.path.size() - (prefix.empty() ? 0 : 1);
  return result;
}

bool whole(const Candidate& candidate) { return candidate.found.error.empty(); }

// Nothing has the path: the side that has most of it says what is wrong.
[[noreturn]] void refuse(const Candidate& own, const Candidate& master, const Candidate& slave,
                         std::string_view path) {
  const std::size_t depth = std::max({own.depth, master.depth, slave.depth});
  if (depth > 0 && own.depth == depth) throw ConfigError(own.found.error);
  if (depth > 0 && master.depth == depth && slave.depth == depth) {
    throw ConfigError(master.found.error + "; and " + slave.found.error);
  }
  if (depth > 0) throw ConfigError(master.depth == depth ? master.found.error : slave.found.error);

  const std::string word(path.substr(0, path.find('.')));
  Names known = field_names(*proto::LabConfig::descriptor());
  for (const auto* side : {proto::MasterConfig::descriptor(), proto::SlaveConfig::descriptor()}) {
    for (const std::string& name : field_names(*side)) {
      if (std::ranges::find(known, name) == known.end()) known.push_back(name);
    }
  }
  throw ConfigError("neither the laboratory nor either side has a field \"" + word + "\"" +
                    instead_of(word, known, "the fields are"));
}

}  // namespace

std::vector<std::string> lab_fields(const std::string& path) {
  // What a file describes, the robot and the scene, is not there yet: its first word says whose it is.
  const proto::LabConfig config;
  const std::string_view word = std::string_view(path).substr(0, path.find('.'));
  const auto has = [&](const google::protobuf::Descriptor* type) {
    return type->FindFieldByName(std::string(word)) != nullptr;
  };
  if (has(proto::LabConfig::descriptor())) return {path};
  std::vector<std::string> fields;
  const bool both = has(proto::MasterConfig::descriptor()) && has(proto::SlaveConfig::descriptor());
  for (const auto& [side, type] : {std::pair{"master.", proto::MasterConfig::descriptor()},
                                   std::pair{"slave.", proto::SlaveConfig::descriptor()}}) {
    if (has(type) && (!both || whole(candidate(config, side, path)))) fields.push_back(side + path);
  }
  if (fields.empty()) fields.push_back(path);
  return fields;
}

void set_lab_field(proto::LabConfig& config, std::string_view setting) {
  const auto equals = setting.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw ConfigError("\"" + std::string(setting) + "\" is not a setting; write PATH=VALUE");
  }
  const std::string_view path = setting.substr(0, equals);
  const std::string_view value = setting.substr(equals + 1);
  const Candidate own = candidate(config, "", path);
  const Candidate master = candidate(config, "master.", path);
  const Candidate slave = candidate(config, "slave.", path);
  if (whole(own)) return set_field(config, own.path, value);
  if (!whole(master) && !whole(slave)) refuse(own, master, slave, path);
  if (!whole(slave)) return set_field(config, master.path, value);
  if (!whole(master)) return set_field(config, slave.path, value);
  if (path != "loop.rate_hz" && path != "accuracy") {
    throw ConfigError(std::string(path) + " exists on both sides; write " + master.path + " or " +
                      slave.path);
  }
  // Both sides tick at one rate in the laboratory, and are as accurate as each other.
  proto::LabConfig changed = config;
  set_field(changed, master.path, value);
  set_field(changed, slave.path, value);
  config.Swap(&changed);
}

}  // namespace longreach
