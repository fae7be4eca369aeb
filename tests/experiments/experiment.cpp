#include "tests/experiments/experiment.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <nlohmann/json.hpp>

#include "commit.hpp"
#include "common/config/config.hpp"

namespace longreach {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> kExperiments = {
      {"touch",
       "Approach, touch, press and probe a wall across the link; is the stiffness in the hand right?",
       run_touch},
  };
  return kExperiments;
}

const Experiment* find_experiment(std::string_view name) {
  for (const Experiment& e : experiments()) {
    if (e.name == name) return &e;
  }
  return nullptr;
}

void resolve(proto::LabConfig& config, const std::filesystem::path& deploy_folder) {
  // Single fields that were set override the profile's.
  proto::LinkProfile profile = load_link_profile(deploy_folder, config.profile());
  profile.mutable_up()->MergeFrom(config.slave().link().impairment());
  profile.mutable_down()->MergeFrom(config.master().link().impairment());
  *config.mutable_slave()->mutable_link()->mutable_impairment() = profile.up();
  *config.mutable_master()->mutable_link()->mutable_impairment() = profile.down();
  config.mutable_master()->mutable_safety()->set_engage_at_start(true);
  resolve_files(*config.mutable_slave(), deploy_folder);
  validate(config);
}

std::string config_hash(const proto::LabConfig& config) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    config.SerializeToCodedStream(&coded);
  }
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = kDigits[(hash >> (4 * i)) & 15];
  return text;
}

std::string_view commit() { return kCommit; }

std::string metrics_json(std::string_view experiment, const ExperimentRun& run,
                         const std::vector<Metric>& metrics) {
  nlohmann::ordered_json json;
  json["experiment"] = experiment;
  json["commit"] = commit();
  json["seed"] = run.seed;
  json["config_hash"] = config_hash(run.config);
  json["metrics"] = nlohmann::ordered_json::object();
  for (const Metric& m : metrics) json["metrics"][m.name] = {{"value", m.value}, {"unit", m.unit}};
  return json.dump(2) + "\n";
}

}  // namespace longreach
