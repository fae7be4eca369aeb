#include "deploy/lab/campaign/results.hpp"

#include <cstdio>
#include <map>

#include "common/text/number_text.hpp"
#include "deploy/lab/campaign/campaign_folder.hpp"

namespace longreach {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// The metrics of one kind as a table.
class Table {
 public:
  explicit Table(const Grid& grid) : grid_(grid) {}

  void set(std::size_t cell, const std::string& column, double value) {
    if (place_.try_emplace(column, columns_.size()).second) columns_.push_back(column);
    rows_[cell][place_[column]] = format_number(value);
  }

  [[nodiscard]] std::string text(const proto::CampaignRecord& record, const CellResults& results) const {
    std::string text = "cell,experiment,seed";
    for (const auto& setting : record.campaign().setting()) text += "," + quoted("set." + setting.path());
    text += ",commit,config";
    for (const std::string& column : columns_) text += "," + quoted(column);
    text += "\n";
    for (std::size_t i = 0; i < results.size(); ++i) {
      text += first_columns(i) + "," + record.commit() + "," + (results[i] ? results[i]->config() : "");
      const auto row = rows_.find(i);
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        text += ",";
        if (row == rows_.end()) continue;
        if (const auto value = row->second.find(c); value != row->second.end()) text += value->second;
      }
      text += "\n";
    }
    return text;
  }

 private:
  [[nodiscard]] std::string first_columns(std::size_t number) const {
    const Cell cell = grid_.cell(number);
    std::string text = std::to_string(number) + "," + cell.experiment + "," + std::to_string(cell.seed);
    for (std::size_t i = 0; i < cell.value.size(); ++i) {
      const auto& setting = grid_.campaign().setting(static_cast<int>(i));
      text += "," + quoted(setting.value(static_cast<int>(cell.value[i])));
    }
    return text;
  }

  const Grid& grid_;
  std::vector<std::string> columns_;
  std::map<std::string, std::size_t> place_;                          // name of a column
  std::map<std::size_t, std::map<std::size_t, std::string>> rows_{};  // indexed by cell and column
};

}  // namespace

std::filesystem::path times_file(const std::filesystem::path& file) {
  std::filesystem::path times = file;
  return times.replace_extension(".times.csv");
}

void write_results(const std::filesystem::path& file, const proto::CampaignRecord& record,
                   const CellResults& results) {
  const Grid grid(record.campaign());
  Table metrics(grid), times(grid);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i]) continue;
    times.set(i, "spent_s", results[i]->spent_s());
    for (const auto& m : results[i]->metric()) (m.of_machine() ? times : metrics).set(i, m.name(), m.value());
  }
  write_whole(file, metrics.text(record, results));
  write_whole(times_file(file), times.text(record, results));
}

std::size_t complain_of_missing(const Grid& grid, const CellResults& results) {
  constexpr std::size_t kNamed = 20;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i] || ++missing > kNamed) continue;
    std::fprintf(stderr, "cell %zu has no result: %s\n", i, grid.name(grid.cell(i)).c_str());
  }
  if (missing > kNamed) std::fprintf(stderr, "and %zu more cells\n", missing - kNamed);
  return missing;
}

}  // namespace longreach
