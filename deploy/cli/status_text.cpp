#include "deploy/cli/status_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace longreach {
namespace {

using proto::Status;

template <class... Arguments>
std::string print(const char* format, Arguments... arguments) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, arguments...);
  return text.data();
}

std::string percent(double fraction) { return print("%.3g %%", 100.0 * fraction); }

void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

std::string position(const google::protobuf::RepeatedField<double>& point_m) {
  std::string text;
  for (const double x_m : point_m) text += print("%.2f ", 1e3 * x_m);
  return text.empty() ? text : text + "mm";
}

std::string state(const Status& status) {
  return status.cause().empty() ? status.state() : status.state() + " (" + status.cause() + ")";
}

std::string silence(const Status& status) {
  if (!status.link().has_silence_s()) return "";
  if (status.link().silence_s() < 0.0) return "no datagram yet";
  return with_unit(status.link().silence_s(), "s") + " ago";
}

std::string joined(const google::protobuf::RepeatedPtrField<std::string>& words) {
  std::string text;
  for (const std::string& word : words) append(text, word);
  return text;
}

std::string recording_cell(const Status& s) {
  if (!s.has_recording()) return "";
  const proto::Recording& r = s.recording();
  std::string text =
      r.file() + print(", %.1f s, ", r.seconds()) + print("%.1f MB", 1e-6 * static_cast<double>(r.bytes()));
  if (!r.running()) text += ": " + r.ended();
  return text;
}

std::string approach(const Status& s) {
  if (!s.has_approach_m_per_s()) return "";
  return print("limited to %.0f mm/s: unknown space", 1e3 * s.approach_m_per_s());
}

std::string energy(const Status& status) {
  if (!status.has_energy_j()) return "";
  return with_unit(status.energy_j(), "J") + ", minimum " + with_unit(status.energy_min_j(), "J");
}

/// A row of the table. The function returns the cell for a side's status; empty if it is unknown.
struct Row {
  const char* label;
  std::string (*cell)(const Status&);
};

constexpr auto kRows = std::to_array<Row>({
    {"version", [](const Status& s) { return s.version(); }},
    {"running for", [](const Status& s) { return s.has_uptime_s() ? print("%.1f s", s.uptime_s()) : ""; }},
    {"state", state},
    {"situation", [](const Status& s) { return s.situation(); }},
    {"state of the other side", [](const Status& s) { return s.far_state(); }},
    {"engagement", [](const Status& s) { return s.has_engagement() ? print("%u", s.engagement()) : ""; }},
    {"robot controlled by", [](const Status& s) { return s.lease(); }},
    {"round trip",
     [](const Status& s) { return s.link().rtt_known() ? with_unit(s.link().rtt_s(), "s") : std::string(); }},
    {"jitter, received",
     [](const Status& s) {
       return s.link().has_jitter_s() ? with_unit(s.link().jitter_s(), "s") : std::string();
     }},
    {"loss, received",
     [](const Status& s) { return s.link().has_loss() ? percent(s.link().loss()) : std::string(); }},
    {"reordered, received",
     [](const Status& s) { return s.link().has_reorder() ? percent(s.link().reorder()) : std::string(); }},
    {"age of the data in use",
     [](const Status& s) { return s.link().has_age_s() ? with_unit(s.link().age_s(), "s") : std::string(); }},
    {"rate, received",
     [](const Status& s) {
       return s.link().has_rate_hz() ? print("%.4g datagrams/s", s.link().rate_hz()) : std::string();
     }},
    {"last datagram", silence},
    {"impairment, received",
     [](const Status& s) { return s.has_impairment() ? in_words(s.impairment()) : std::string(); }},
    {"mode", [](const Status& s) { return s.mode(); }},
    {"scale", [](const Status& s) { return s.has_scale() ? print("%.4g", s.scale()) : ""; }},
    {"kv",
     [](const Status& s) { return s.has_master_view() ? print("%.4g", s.master_view().kv_per_s()) : ""; }},
    {"hand", [](const Status& s) { return position(s.hand_m()); }},
    {"tool", [](const Status& s) { return position(s.tool_m()); }},
    {"goal", [](const Status& s) { return position(s.goal_m()); }},
    {"contact",
     [](const Status& s) { return std::string(!s.has_in_contact() ? ""
                                              : s.in_contact()    ? "yes"
                                                                  : "no"); }},
    {"stiffness",
     [](const Status& s) {
       return s.has_stiffness_n_per_m() ? print("%.4g N/m", s.stiffness_n_per_m()) : std::string();
     }},
    {"rotational stiffness",
     [](const Status& s) {
       return s.has_rotational_stiffness_nm_per_rad()
                  ? print("%.4g N m/rad", s.rotational_stiffness_nm_per_rad())
                  : std::string();
     }},
    {"contact estimate", [](const Status& s) { return s.estimate(); }},
    {"gripper", [](const Status& s) { return s.gripper(); }},
    {"force sensor", [](const Status& s) { return s.sensor(); }},
    {"force sensor warning", [](const Status& s) { return s.sensor_warning(); }},
    {"force", [](const Status& s) { return s.has_force_n() ? print("%.3g N", s.force_n()) : std::string(); }},
    {"force of contact or limit",
     [](const Status& s) { return s.has_contact_n() ? print("%.3g N", s.contact_n()) : std::string(); }},
    {"energy from the hand", energy},
    {"clamped", [](const Status& s) { return joined(s.clamped()); }},
    {"approach", approach},
    {"recording", recording_cell},
});

/// Rows that are left out of a terminal that is too small.
constexpr auto kDetails = std::to_array<std::string_view>(
    {"version", "running for", "state of the other side", "engagement", "robot controlled by",
     "jitter, received", "reordered, received", "age of the data in use", "rate, received",
     "impairment, received", "hand", "goal", "rotational stiffness", "contact estimate", "force sensor",
     "energy from the hand", "approach", "recording"});

struct Line {
  std::string label;
  std::string master;
  std::string slave;
  bool detail = false;
};

std::uint64_t count_of(const SideReport& report, const std::string& name) {
  if (!report.status) return 0;
  for (const proto::NamedCount& counter : report.status->counters())
    if (counter.name() == name) return counter.count();
  return 0;
}

/// Adds one line for each counter that is not zero on at least one side, in the order in which the sides
/// report them.
void add_counters(const BothReports& reports, std::vector<Line>& lines) {
  std::vector<std::string> seen;
  for (const SideReport* report : {&reports.master, &reports.slave}) {
    if (!report->status) continue;
    for (const proto::NamedCount& counter : report->status->counters()) {
      if (counter.count() == 0 || std::ranges::find(seen, counter.name()) != seen.end()) continue;
      seen.push_back(counter.name());
      const std::uint64_t master = count_of(reports.master, counter.name());
      const std::uint64_t slave = count_of(reports.slave, counter.name());
      lines.push_back({"count of " + counter.name(), master == 0 ? "" : std::to_string(master),
                       slave == 0 ? "" : std::to_string(slave), true});
    }
  }
}

std::string answers(const SideReport& report) {
  return report.status ? "yes" : report.awaited ? "not yet" : "no";
}
std::string age(const SideReport& report) { return report.status ? with_unit(report.age_s, "s") : ""; }

std::string column(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 1, ' ');
}

std::string line_of(const SideReport& report) {
  std::string text(name_of(report.side));
  if (!report.status) return text + " does not respond at " + report.address;
  const Status& status = *report.status;
  text += " " + state(status);
  append(text, "age " + age(report));
  if (status.link().rtt_known()) append(text, "rtt " + with_unit(status.link().rtt_s(), "s"));
  if (status.link().has_jitter_s()) append(text, "jitter " + with_unit(status.link().jitter_s(), "s"));
  if (status.link().has_loss()) append(text, "loss " + percent(status.link().loss()));
  if (!status.situation().empty()) append(text, status.situation());
  if (status.has_mode()) append(text, status.mode());
  if (status.has_scale()) append(text, print("scale %.4g", status.scale()));
  if (status.in_contact()) append(text, print("%.4g N/m", status.stiffness_n_per_m()));
  if (!status.estimate().empty()) append(text, status.estimate());
  if (status.has_force_n()) append(text, print("%.3g N", status.force_n()));
  if (!status.clamped().empty()) append(text, "clamped: " + joined(status.clamped()));
  return text;
}

void add_window(std::string& text, const char* what, double start_s, double duration_s, double period_s) {
  std::string words = what + (" for " + with_unit(duration_s, "s"));
  if (start_s > 0.0) words += " from " + with_unit(start_s, "s");
  if (period_s > 0.0) words += " every " + with_unit(period_s, "s");
  append(text, words);
}

}  // namespace

std::string with_unit(double value, std::string_view unit) {
  struct Prefix {
    double factor;
    const char* letter;
  };
  constexpr std::array<Prefix, 2> kSmall{{{1e3, "m"}, {1e6, "u"}}};
  // Removes digits that are only rounding errors of a sum.
  if (std::abs(value) < 1e-12) value = 0.0;
  double shown = value;
  std::string prefix;
  for (const Prefix& p : kSmall) {
    if (value == 0.0 || std::abs(shown) >= 1.0) break;
    shown = value * p.factor;
    prefix = p.letter;
  }
  return print("%.4g ", shown) + prefix + std::string(unit);
}

std::string in_words(const proto::Impairment& link) {
  std::string text;
  if (link.delay_s() != 0.0) append(text, "delay " + with_unit(link.delay_s(), "s"));
  if (link.jitter_s() != 0.0) append(text, "jitter " + with_unit(link.jitter_s(), "s"));
  if (link.loss() != 0.0) {
    append(text, "loss " + percent(link.loss()));
    if (link.loss_burst() > 1.0) text += print(" in bursts of %.4g", link.loss_burst());
  }
  if (link.duplicate() != 0.0) append(text, "duplicate " + percent(link.duplicate()));
  if (link.reorder() != 0.0) append(text, "reorder " + percent(link.reorder()));
  if (link.corrupt() != 0.0) append(text, "corrupt " + percent(link.corrupt()));
  if (link.rate_bit_per_s() != 0.0) {
    append(text, print("rate %.6g bit/s", link.rate_bit_per_s()));
    text += " with a queue of " + with_unit(link.queue_s(), "s");
  }
  if (link.step_duration_s() != 0.0 && link.step_delay_s() != 0.0)
    add_window(text, ("delay step of " + with_unit(link.step_delay_s(), "s")).c_str(), link.step_start_s(),
               link.step_duration_s(), 0.0);
  if (link.drift_s_per_s() != 0.0) append(text, print("drift %.4g s/s", link.drift_s_per_s()));
  if (link.blackout_duration_s() != 0.0)
    add_window(text, "blackout", link.blackout_start_s(), link.blackout_duration_s(),
               link.blackout_period_s());
  if (link.rpc_delay_s() != 0.0) append(text, "round trip of calls " + with_unit(link.rpc_delay_s(), "s"));
  return text.empty() ? "none" : text;
}

namespace {

std::vector<Line> lines_of(const BothReports& reports) {
  std::vector<Line> lines{{"", "master", "slave"},
                          {"address", reports.master.address, reports.slave.address, true},
                          {"answers", answers(reports.master), answers(reports.slave)},
                          {"age of these values", age(reports.master), age(reports.slave)}};
  for (const Row& row : kRows) {
    Line line{row.label, reports.master.status ? row.cell(*reports.master.status) : "",
              reports.slave.status ? row.cell(*reports.slave.status) : "",
              std::ranges::find(kDetails, row.label) != kDetails.end()};
    if (!line.master.empty() || !line.slave.empty()) lines.push_back(std::move(line));
  }
  add_counters(reports, lines);
  return lines;
}

/// Returns the table. A master's cell is at most `cell_max` long.
std::string table_of(const std::vector<Line>& lines, std::size_t cell_max) {
  std::size_t label_width = 0;
  std::size_t master_width = 0;
  for (const Line& line : lines) {
    label_width = std::max(label_width, line.label.size() + 2);
    master_width = std::max(master_width, std::min(line.master.size(), cell_max) + 3);
  }
  std::string text;
  for (const Line& line : lines) {
    std::string row =
        column(line.label, label_width) + column(line.master.substr(0, cell_max), master_width) + line.slave;
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

/// Returns the sentences about both sides, one a line.
std::string sentences_of(const BothReports& reports) {
  std::string text;
  if (reports.master.status && !reports.master.status->happening().empty())
    text += "Now: " + reports.master.status->happening() + "\n";
  for (const SideReport* report : {&reports.master, &reports.slave}) {
    if (report->status)
      for (const std::string& sentence : report->status->reduced_protection())
        text += "Reduced protection (" + std::string(name_of(report->side)) + "): " + sentence + "\n";
    if (report->status && !report->status->trouble().empty())
      text += "The " + std::string(name_of(report->side)) + " reports: " + report->status->trouble() + "\n";
    if (report->status && !report->status->refusal().empty())
      text += "Not engaged: " + report->status->refusal() + "\n";
  }
  return text;
}

}  // namespace

std::string status_table(const BothReports& reports) {
  return table_of(lines_of(reports), std::string::npos) + sentences_of(reports);
}

std::string folded(const std::string& text, std::size_t columns) {
  std::string out;
  std::size_t begin = 0, space = std::string::npos;
  for (const char c : text) {
    if (c == '\n') {
      begin = out.size() + 1;
      space = std::string::npos;
    } else if (c == ' ') {
      space = out.size();
    }
    out += c;
    if (out.size() - begin <= columns || space == std::string::npos) continue;
    out[space] = '\n';
    begin = space + 1;
    space = std::string::npos;
  }
  return out;
}

std::string watch_table(const BothReports& reports, std::size_t columns, std::size_t rows) {
  constexpr std::size_t kLabel = 27;  // of the longest label that is not a detail
  std::vector<Line> lines = lines_of(reports);
  const std::string sentences = folded(sentences_of(reports), columns);
  const auto needed = lines.size() + static_cast<std::size_t>(std::ranges::count(sentences, '\n'));
  if (needed > rows) std::erase_if(lines, [](const Line& line) { return line.detail; });
  const std::size_t cell_max = columns > kLabel + 20 ? (columns - kLabel) / 2 : 10;
  return sentences + table_of(lines, cell_max);
}

std::string status_line(const BothReports& reports) {
  return line_of(reports.master) + " | " + line_of(reports.slave);
}

}  // namespace longreach
