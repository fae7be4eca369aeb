#include "deploy/lab/campaign/grid.hpp"

#include <algorithm>

namespace longreach {
namespace {

/// Both factors must be at most 2^32.
std::size_t bounded_product(std::size_t a, std::size_t b) { return std::min(a * b, Grid::kCellsMax + 1); }

}  // namespace

Grid::Grid(proto::Campaign campaign) : campaign_(std::move(campaign)) {}

std::size_t Grid::seeds() const { return std::size_t{campaign_.seeds().to()} - campaign_.seeds().from() + 1; }

std::size_t Grid::combinations() const {
  std::size_t count = 1;
  for (const auto& setting : campaign_.setting())
    count = bounded_product(count, static_cast<std::size_t>(setting.value_size()));
  return count;
}

std::size_t Grid::size() const {
  const auto experiments = static_cast<std::size_t>(campaign_.experiment_size());
  return bounded_product(bounded_product(experiments, combinations()), seeds());
}

Cell Grid::cell(std::size_t number) const {
  Cell cell;
  cell.number = number;
  cell.seed = campaign_.seeds().from() + number % seeds();
  const std::size_t run = number / seeds();
  cell.combination = run % combinations();
  cell.experiment = campaign_.experiment(static_cast<int>(run / combinations()));
  std::size_t rest = cell.combination;
  for (int i = campaign_.setting_size() - 1; i >= 0; --i) {
    const auto values = static_cast<std::size_t>(campaign_.setting(i).value_size());
    cell.value.insert(cell.value.begin(), rest % values);
    rest /= values;
  }
  return cell;
}

std::vector<std::string> Grid::settings(const Cell& cell) const {
  std::vector<std::string> settings;
  for (int i = 0; i < campaign_.setting_size(); ++i) {
    const auto& setting = campaign_.setting(i);
    const std::string& value = setting.value(static_cast<int>(cell.value[static_cast<std::size_t>(i)]));
    settings.push_back(setting.path() + "=" + value);
    for (const std::string& also : setting.also()) settings.push_back(also + "=" + value);
  }
  return settings;
}

std::string Grid::name(const Cell& cell) const {
  std::string name = cell.experiment;
  for (const std::string& setting : settings(cell)) name += " " + setting;
  return name + " seed=" + std::to_string(cell.seed);
}

}  // namespace longreach
