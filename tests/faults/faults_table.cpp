#include "tests/faults/faults_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "tests/faults/invariant.hpp"
#include "tests/faults/kind.hpp"

namespace longreach {
namespace {

constexpr int kRow_px = 17, kTop_px = 92, kColumn_px = 400, kName_px = 205, kBar_px = 110, kCount_px = 185,
              kRoom_px = 130;

struct Row {
  std::string name;
  std::uint64_t times = 0;
  std::uint64_t violated = 0;
};
/// What does not exist in virtual time, and the tests with real programs that try it (tests/process,
/// tests/unit).
struct Elsewhere {
  const char* what;
  const char* tests;
};
constexpr Elsewhere kElsewhere[] = {
    {"kill -9 of either side, free and in contact", "SafetyOfPrograms"},
    {"restarts; engaged again and again", "SafetyOfPrograms"},
    {"frozen for 10 ms to 60 s, real programs", "ClocksOfPrograms"},
    {"the host suspended", "RealTimeLoop, SideClock"},
    {"full or slow disk for recordings", "Recording"},
    {"a log or a terminal that nobody reads", "Blocked"},
    {"idle connections, unfinished handshakes", "Connections, Soak"},
    {"descriptors exhausted", "Connections"},
    {"flood of RPC and of forged datagrams", "UnderLoad"},
    {"streams that nobody reads", "Soak, View"},
    {"stop beside thousands of changes", "StopAtOnce"},
    {"wrong, foreign and expired certificates", "Refusals"},
    {"two to five masters; a stolen session", "Lease, Refusals"},
    {"another source address", "HostileSocket"},
    {"another local user with a socket", "Adapters, View"},
    {"adapters that are killed, stall or lie", "Adapters"},
    {"I18 one lease, one key", "Lease, Refusals"},
    {"I26 memory and descriptors over a day", "Soak"},
    {"L5 a dead master's lease", "Lease"},
    {"L6 a call after an attack", "StopAtOnce, Soak"},
    {"L7 the recorder goes on", "Recording"},
};

struct Section {
  const char* title;
  const char* what;
  std::vector<Row> rows;
};

std::vector<Section> sections(const Tally& t) {
  std::vector<Section> all = {
      {"faults", "times injected", {}}, {"guards", "times acted", {}}, {"invariants", "times judged", {}}};
  for (const FaultKind& kind : fault_kinds()) {
    const auto at = t.kinds.find(std::string(kind.name));
    all[0].rows.push_back({std::string(kind.name), at == t.kinds.end() ? 0 : at->second});
  }
  for (const auto& [name, times] : t.guards) all[1].rows.push_back({name, times});
  for (const auto& [name, times] : t.judged) {
    const auto at = t.violated.find(name);
    all[2].rows.push_back({name, times, at == t.violated.end() ? 0 : at->second});
  }
  return all;
}

std::string text_at(int x, int y, const std::string& style, const std::string& text) {
  return "<text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" " + style + ">" + text +
         "</text>\n";
}

/// Its length is the logarithm of the count.
std::string row_at(int x, int y, const Row& row) {
  const auto length = static_cast<int>(kBar_px * std::log10(1.0 + static_cast<double>(row.times)) / 10.0);
  const char* fill = row.violated > 0 ? "#d55e00" : "#7fb3d5";
  std::string count = std::to_string(row.times);
  if (row.violated > 0) count += ", violated " + std::to_string(row.violated);
  return text_at(x + kName_px - 6, y + 12, "font-size=\"12\" text-anchor=\"end\"", row.name) + "<rect x=\"" +
         std::to_string(x + kName_px) + "\" y=\"" + std::to_string(y + 3) + "\" width=\"" +
         std::to_string(std::max(1, length)) + "\" height=\"11\" fill=\"" + fill + "\"/>\n" +
         text_at(x + kName_px + std::max(1, length) + 5, y + 12, "font-size=\"11\" fill=\"#444444\"", count);
}

void programs(std::string& body, int x, int y) {
  body += text_at(x + kName_px - 6, y - 8, "font-size=\"13\" font-weight=\"bold\" text-anchor=\"end\"",
                  "with real programs") +
          text_at(x + kName_px, y - 8, "font-size=\"12\" fill=\"#666666\"", "tests");
  for (const Elsewhere& e : kElsewhere) {
    body += text_at(x + kName_px - 6, y + 12, "font-size=\"12\" text-anchor=\"end\"", e.what) +
            text_at(x + kName_px, y + 12, "font-size=\"11\" fill=\"#444444\"", e.tests);
    y += kRow_px;
  }
}

/// What each invariant says.
void words(std::string& body, const Section& invariants, int x, int y) {
  std::map<std::string_view, std::string_view> says = {
      {"I17", "what is refused changes nothing but counters (the same run, attacked)"},
      {"L4", "nothing holds where nothing is wrong but 1 % of loss"},
      {"M1", "other clocks change nothing (the same run, hours later)"}};
  for (const auto& invariant : all_invariants(draw_scenario(1))) says[invariant->name()] = invariant->says();
  for (const Row& row : invariants.rows) {
    body += text_at(x, y + 12, "font-size=\"12\"", std::string(says[row.name]));
    y += kRow_px;
  }
}

std::string svg(const Tally& tally) {
  std::string body;
  int x = 8, lowest = 0;
  const std::vector<Section> all = sections(tally);
  // The faults are as many as all others: two columns of them.
  const std::size_t half = (all[0].rows.size() + 1) / 2;
  const auto column = [&](const Section& section, std::size_t first, std::size_t end, int y) {
    body += text_at(x + kName_px - 6, y - 8, "font-size=\"13\" font-weight=\"bold\" text-anchor=\"end\"",
                    section.title);
    body += text_at(x + kName_px, y - 8, "font-size=\"12\" fill=\"#666666\"", section.what);
    for (std::size_t i = first; i < end; ++i, y += kRow_px) body += row_at(x, y, section.rows[i]);
    lowest = std::max(lowest, y);
    return y;
  };
  int left = column(all[0], 0, half, kTop_px);
  x += kColumn_px;
  left = std::max(left, column(all[0], half, all[0].rows.size(), kTop_px)) + 3 * kRow_px;
  x += kColumn_px + kRoom_px;
  const int right = column(all[1], 0, all[1].rows.size(), kTop_px) + 3 * kRow_px;
  programs(body, x, right);
  lowest = std::max(lowest, right + static_cast<int>(std::size(kElsewhere)) * kRow_px);
  const int right_px = x + kColumn_px;
  x = 8;
  column(all[2], 0, all[2].rows.size(), left);
  words(body, all[2], x + kName_px + kCount_px, left);
  const std::string width = std::to_string(right_px + 8), height = std::to_string(lowest + 12);
  char hours[96];
  std::snprintf(hours, sizeof hours,
                "%.1f virtual hours of %llu seeds, %.0f %% of them engaged; bars are logarithmic",
                tally.virtual_s / 3600.0, static_cast<unsigned long long>(tally.seeds),
                100.0 * tally.engaged_s / std::max(1.0, tally.virtual_s));
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
         "\" viewBox=\"0 0 " + width + " " + height +
         "\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         text_at(14, 28, "font-size=\"17\"", "Nothing that lies may move the robot") +
         text_at(14, 50, "font-size=\"12\" fill=\"#666666\"", hours) + body + "</svg>\n";
}

std::string csv(const Tally& tally) {
  std::string text = "what,name,times,violated\n";
  for (const Section& section : sections(tally)) {
    for (const Row& row : section.rows)
      text += std::string(section.title) + ",\"" + row.name + "\"," + std::to_string(row.times) + "," +
              std::to_string(row.violated) + "\n";
  }
  for (const Elsewhere& e : kElsewhere)
    text += std::string("with real programs,\"") + e.what + "\",\"" + e.tests + "\",\n";
  return text;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::trunc);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string() + ": check free disk space");
}

}  // namespace

void write_faults(const std::filesystem::path& folder, const Tally& tally) {
  write(folder / "faults.csv", csv(tally));
  write(folder / "faults.svg", svg(tally));
}

}  // namespace longreach
