#include "deploy/lab/campaign/plan.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "common/config/config.hpp"
#include "common/config/text_place.hpp"
#include "common/text/nearest_name.hpp"
#include "deploy/lab/experiment.hpp"
#include "deploy/lab/name_hash.hpp"
#include "deploy/lab/settings_used.hpp"

namespace longreach {
namespace {

namespace fs = std::filesystem;
using google::protobuf::Message;

/// Checks a campaign file and reports errors with their position.
class Checker {
 public:
  Checker(const fs::path& file, const proto::Campaign& campaign) : file_(file), campaign_(campaign) {}

  void experiments() const {
    if (campaign_.experiment().empty())
      throw ConfigError(file_.string() + ": the file must name at least one experiment");
    Names known;
    for (const Experiment& e : longreach::experiments()) known.emplace_back(e.name);
    std::set<std::string> names;
    for (int i = 0; i < campaign_.experiment_size(); ++i) {
      const std::string& name = campaign_.experiment(i);
      if (find_experiment(name) == nullptr)
        refuse({step(campaign_, "experiment", i)},
               "unknown experiment \"" + name + "\"" + instead_of(name, known, "known are"));
      if (!names.insert(name).second)
        refuse({step(campaign_, "experiment", i)}, "experiment \"" + name + "\" is given twice");
    }
  }

  void settings() const {
    std::set<std::string> paths;
    for (int i = 0; i < campaign_.setting_size(); ++i) {
      const auto& setting = campaign_.setting(i);
      const PathStep at = step(campaign_, "setting", i);
      if (setting.path().empty()) refuse({at}, "the setting has no path");
      take(setting.path(), {at, step(setting, "path", -1)}, paths);
      for (int k = 0; k < setting.also_size(); ++k)
        take(setting.also(k), {at, step(setting, "also", k)}, paths);
      if (setting.value().empty())
        refuse({at}, "setting \"" + setting.path() + "\" has no value, so the grid is empty");
      std::set<std::string> values;
      for (int v = 0; v < setting.value_size(); ++v) {
        if (!values.insert(setting.value(v)).second)
          refuse({at, step(setting, "value", v)},
                 "setting \"" + setting.path() + "\" contains the value \"" + setting.value(v) + "\" twice");
      }
    }
  }

  void seeds() const {
    const auto& seeds = campaign_.seeds();
    if (seeds.from() > seeds.to())
      refuse({step(campaign_, "seeds", -1)}, "seeds.from = " + std::to_string(seeds.from()) +
                                                 " is greater than seeds.to = " + std::to_string(seeds.to()) +
                                                 "; the grid is empty");
  }

  /// Rejects settings that an experiment does not use. Call it after all paths have been checked.
  void unused() const {
    for (int i = 0; i < campaign_.setting_size(); ++i) {
      const auto& setting = campaign_.setting(i);
      for (const std::string& name : campaign_.experiment()) {
        const Experiment& experiment = *find_experiment(name);
        const PathStep at = step(campaign_, "setting", i);
        if (!uses_setting(experiment, setting.path()))
          refuse({at, step(setting, "path", -1)}, unused_sentence(experiment, setting.path()));
        for (int k = 0; k < setting.also_size(); ++k)
          if (!uses_setting(experiment, setting.also(k)))
            refuse({at, step(setting, "also", k)}, unused_sentence(experiment, setting.also(k)));
      }
    }
  }

  /// Reports the error of a cell at the first setting with which it occurs.
  [[noreturn]] void refuse_cell(const Grid& grid, const Cell& cell, const fs::path& deploy) const {
    const std::vector<std::string> all = grid.settings(cell);
    std::vector<int> of;  // index of the setting that each element belongs to
    for (int i = 0; i < campaign_.setting_size(); ++i)
      of.insert(of.end(), static_cast<std::size_t>(1 + campaign_.setting(i).also_size()), i);
    for (std::size_t n = 0; n <= all.size(); ++n) {
      try {
        static_cast<void>(configure({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n)}, deploy,
                                    fs::absolute(file_).parent_path()));
      } catch (const ConfigError& e) {
        if (n == 0) throw;
        const PathStep setting = step(campaign_, "setting", of[n - 1]);
        const auto value = static_cast<int>(cell.value[static_cast<std::size_t>(of[n - 1])]);
        refuse({setting, step(campaign_.setting(setting.index), "value", value)}, e.what());
      }
    }
    throw ConfigError(file_.string() + ": the files in " + deploy.string() +
                      " changed while the grid was being checked; run the command again");
  }

 private:
  static PathStep step(const Message& message, const char* field, int index) {
    return {message.GetDescriptor()->FindFieldByName(field), index};
  }
  /// Records the fields that a path sets. `mapping.scale` and `master.mapping.scale` are the same field.
  void take(const std::string& path, const FieldPath& at, std::set<std::string>& known) const {
    for (const std::string& field : lab_fields(path)) {
      if (!known.insert(field).second)
        refuse(at, "setting \"" + path + "\" is given twice" + (field == path ? "" : ", as " + field));
    }
  }
  [[noreturn]] void refuse(const FieldPath& path, const std::string& why) const {
    throw ConfigError(place_in_file(file_, campaign_, path) + ": " + why);
  }

  const fs::path& file_;
  const proto::Campaign& campaign_;
};

}  // namespace

Plan load_plan(const fs::path& file, const fs::path& deploy_folder) {
  proto::Campaign campaign;
  load_text_file(file, campaign);
  const Checker check(file, campaign);
  check.experiments();
  check.settings();
  check.seeds();
  Plan plan{Grid(campaign), fs::absolute(file).lexically_normal().parent_path(), {}, {}};
  if (plan.grid.size() > Grid::kCellsMax)
    throw ConfigError(file.string() + ": the grid has more than " + std::to_string(Grid::kCellsMax) +
                      " cells; split it into several campaigns");
  std::string configs;
  for (std::size_t i = 0; i < plan.grid.combinations(); ++i) {
    const std::size_t seeds = campaign.seeds().to() - campaign.seeds().from() + std::size_t{1};
    const Cell cell = plan.grid.cell(i * seeds);
    try {
      plan.configs.push_back(config_hash(configure(plan.grid.settings(cell), deploy_folder, plan.folder)));
    } catch (const ConfigError&) {
      check.refuse_cell(plan.grid, cell, deploy_folder);
    }
    configs += plan.configs.back();
  }
  check.unused();
  plan.record.set_commit(program_name());
  plan.record.set_full(full_size());
  plan.record.set_configs(name_hash(configs));
  *plan.record.mutable_campaign() = campaign;
  return plan;
}

std::string program_name() {
  std::string name(commit());
  if (!name.ends_with("-dirty") && name != "unknown") return name;
  std::ifstream program("/proc/self/exe", std::ios::binary);
  return name + "-" + name_hash(std::string(std::istreambuf_iterator<char>(program), {}));
}

bool full_size() { return std::getenv("LONGREACH_FULL") != nullptr; }

}  // namespace longreach
