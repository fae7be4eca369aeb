#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numeric>
#include <vector>

#include "common/link/boundary_words.hpp"
#include "common/link/estimate_words.hpp"
#include "common/link/protection.hpp"
#include "master/console/terminal_view.hpp"
#include "master/console/words.hpp"
#include "master/input/keys.hpp"

namespace longreach {
namespace {

constexpr std::size_t kPlainColumns = 120;

constexpr int kWidthMin = 60;
constexpr int kWidthMax = 110;
constexpr int kLabel = 10;  // width of the first column

enum class Tone { kPlain, kDim, kGood, kWarn, kBad };

// The only function here that formats numbers. Values that are not finite are shown as such.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::array<char, 256> line{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  return line.data();
}

std::string_view tone_code(Tone tone) {
  switch (tone) {
    case Tone::kDim:
      return "\x1b[2m";
    case Tone::kGood:
      return "\x1b[32m";
    case Tone::kWarn:
      return "\x1b[33m";
    case Tone::kBad:
      return "\x1b[31m";
    case Tone::kPlain:
      break;
  }
  return "";
}

/// Lines that do not fit into a small terminal are left out in this order.
enum class Weight { kBlank, kDetail, kValue, kMain };

// Collects lines that are no longer than the width; what is longer continues below. Colours are added after the lines are
// cut, so that they do not count.
class Page {
 public:
  Page(int width, bool color) : width_(static_cast<std::size_t>(width)), color_(color) {}

  void line(std::string_view label, const std::string& content, Tone tone = Tone::kPlain,
            Weight weight = Weight::kValue) {
    std::string row(label), text;
    row.resize(kLabel, ' ');
    const auto parts = cut(content, width_ - kLabel);
    for (const std::string_view part : parts) {
      text += painted(row, Tone::kDim) + painted(std::string(part), tone) + "\n";
      row.assign(kLabel, ' ');
    }
    lines_.push_back({text, weight, parts.size()});
  }
  void blank() { lines_.push_back({"\n", Weight::kBlank}); }
  void whole(std::string_view sentence, Tone tone) {
    for (const std::string_view part : cut(sentence, width_))
      lines_.push_back({painted(std::string(part), tone) + "\n", Weight::kMain});
  }
  /// Returns at most `rows` lines. If values are left out, the last line says so.
  [[nodiscard]] std::string take(std::size_t rows) {
    const std::size_t blank =
        static_cast<std::size_t>(std::ranges::count(lines_, Weight::kBlank, &Line::weight));
    const std::size_t values = height() - blank;
    if (values > rows) leave_out(values, rows);
    remove(Weight::kBlank, rows);
    std::string text;
    for (const Line& line : lines_) text += line.text;
    return text;
  }

 private:
  struct Line {
    std::string text;  // of `rows` rows
    Weight weight = Weight::kMain;
    std::size_t rows = 1;
  };

  /// Parts of at most `width` characters, at spaces where there are any.
  static std::vector<std::string_view> cut(std::string_view text, std::size_t width) {
    std::vector<std::string_view> parts;
    while (text.size() > width) {
      std::size_t end = text.rfind(' ', width);
      if (end == std::string_view::npos || end == 0) end = width;
      parts.push_back(text.substr(0, end));
      text.remove_prefix(std::min(text.find_first_not_of(' ', end), text.size()));
    }
    parts.push_back(text);
    return parts;
  }
  [[nodiscard]] std::size_t height() const {
    std::size_t rows = 0;
    for (const Line& line : lines_) rows += line.rows;
    return rows;
  }
  /// Removes lines of this weight, the last first, until at most `rows` are left.
  void remove(Weight weight, std::size_t rows) {
    for (std::size_t i = lines_.size(); height() > rows && i-- > 0;)
      if (lines_[i].weight == weight) lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  void leave_out(std::size_t values, std::size_t rows) {
    remove(Weight::kBlank, 0);
    for (const Weight weight : {Weight::kDetail, Weight::kValue, Weight::kMain}) remove(weight, rows - 1);
    whole(text("%zu more lines need a terminal of %zu rows", values - height(), values), Tone::kDim);
  }
  [[nodiscard]] std::string painted(const std::string& content, Tone tone) const {
    if (!color_ || tone == Tone::kPlain || content.empty()) return content;
    return std::string(tone_code(tone)) + content + "\x1b[0m";
  }

  std::size_t width_;
  bool color_;
  std::vector<Line> lines_;
};

std::string bar(double value, double full, int length) {
  const double share =
      full > 0.0 && value > 0.0 ? std::min(value / full, 1.0) : 0.0;  // NaN gives an empty bar
  const int filled = static_cast<int>(std::lround(share * length));
  return "[" + std::string(static_cast<std::size_t>(filled), '=') +
         std::string(static_cast<std::size_t>(length - filled), '.') + "]";
}

std::string millimetres(const Vector3& p_m) {
  return text("x %+8.2f  y %+8.2f  z %+8.2f mm", p_m.x() * 1e3, p_m.y() * 1e3, p_m.z() * 1e3);
}

Tone tone_of(SafetyState state) {
  switch (state) {
    case SafetyState::kEngaged:
      return Tone::kGood;
    case SafetyState::kHolding:
      return Tone::kWarn;
    case SafetyState::kStopped:
    case SafetyState::kFault:
      return Tone::kBad;
    default:
      return Tone::kPlain;
  }
}

std::string state_line(const ConsoleSnapshot& s) {
  std::string line(state_in_words(s.view.state));
  line += ", slave " + (s.view.far_known ? std::string(state_in_words(s.view.far_state)) : "no data yet");
  if (s.view.cause != HoldCause::kNone) line += " (" + cause_in_words(s.view) + ")";
  return line;
}

std::string link_line(const LinkFigures& link) {
  const std::string rtt = link.rtt_s ? text("RTT %.3f s", *link.rtt_s) : "RTT unknown";
  const std::string age = link.age_s ? text("  age %.2f s", *link.age_s) : "";
  const std::string silence =
      std::isfinite(link.silence_s) ? text("  silent for %.2f s", link.silence_s) : "  no datagram yet";
  return rtt + age + text("  jitter %.1f ms", link.jitter_s * 1e3) + silence;
}

std::string datagrams_line(const LinkFigures& link) {
  return text("%.1f %% lost, %.1f %% reordered", link.loss * 100.0, link.reorder * 100.0);
}

/// Returns the state of the gripper if it is worth showing; an open gripper is not.
std::string gripper_in_words(const MasterView& view) {
  const GripperState& there = view.far.gripper;
  if (view.grip && *view.grip != there.closed) return *view.grip ? ", gripper closes" : ", gripper opens";
  return there.closed || there.holds ? ", gripper " + in_words(there) : "";
}

std::string mode_line(const MasterView& view) {
  return text("%s, scale %.2f, kv %.3g/s%s%s", std::string(mode_in_words(view.mode)).c_str(), view.scale,
              view.kv_per_s, view.clutched ? ", clutched" : "", gripper_in_words(view).c_str());
}

std::string tool_line(const ConsoleSnapshot& s) {
  if (!s.view.far_known) return "no data yet";
  const Vector3& p = s.view.far.X_WE.p;
  std::string line = text("x %+8.4f  y %+8.4f  z %+8.4f m", p.x(), p.y(), p.z());
  if (const auto age_s = age_of_news_s(s)) line += text("  (%.1f s ago)", *age_s);
  return line;
}

std::string stiffness_line(const ConsoleSnapshot& s) {
  const ContactEstimate& estimate = s.view.far.estimate;
  std::string line = text("%.3f N/mm at the hand", s.view.stiffness_n_per_m * 1e-3);
  if (s.view.far_known && estimate.valid) {
    line += text(", slave estimates %.3f within %.2g %%", estimate.stiffness_n_per_m * 1e-3,
                 100.0 * estimate.stiffness_sd_n_per_m / estimate.stiffness_n_per_m);
  }
  return line;
}

// Returns the slave's estimate of the contact with its accuracy.
std::string contact_line(const ConsoleSnapshot& s) {
  const Telemetry& robot = s.view.far;
  if (s.view.far_known && robot.estimate.valid) return law_in_words(robot.estimate);
  if (s.view.in_contact) return "not yet known";
  const bool limit =
      s.view.far_known && !boundary_in_words(robot.clamps, robot.X_WE, robot.X_WE_goal).empty();
  return limit && s.view.spring_force_n.norm() > 0.0 ? "none; the hand feels the limit of the robot" : "none";
}

std::uint64_t total(const RejectionCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::string rejected_line(const ConsoleSnapshot& s) {
  std::string line = text("%llu ticks late, %llu missed, ", static_cast<unsigned long long>(s.late_ticks),
                          static_cast<unsigned long long>(s.missed_ticks));
  line += text("%llu rejected", static_cast<unsigned long long>(total(s.rejected) + s.view.rejected_values));
  for (std::size_t i = 0; i < s.rejected.size(); ++i) {
    if (s.rejected[i] == 0) continue;
    line += text(" %s %llu", std::string(to_string(static_cast<Rejection>(i))).c_str(),
                 static_cast<unsigned long long>(s.rejected[i]));
  }
  return line;
}

void add_forces(Page& page, const ConsoleSnapshot& s, int width) {
  const int length = std::clamp(width - kLabel - 24, 10, 50);
  const double hand = s.view.F_H_M.force.norm();
  const double robot = s.view.far_known ? s.view.far.F_E_W.force.norm() : 0.0;
  page.line("hand",
            text("%7.2f N ", hand) + bar(hand, s.force_max_n, length) + text(" %.0f N", s.force_max_n),
            s.view.force_clamped ? Tone::kWarn : Tone::kPlain);
  page.line("robot",
            text("%7.2f N ", robot) + bar(robot, s.force_max_n, length) +
                (s.view.silent ? " when last received" : ""),
            s.view.silent ? Tone::kDim : Tone::kPlain);
}

void add_clamps(Page& page, const std::vector<std::string>& clamps) {
  if (clamps.empty()) page.line("clamped", "nothing", Tone::kDim, Weight::kDetail);
  for (std::size_t i = 0; i < clamps.size(); ++i) page.line(i == 0 ? "clamped" : "", clamps[i], Tone::kWarn);
}

std::string clock_line(const ConsoleSnapshot& s) {
  std::string line = text("longreach master  %.1f s", s.seconds);
  if (s.seconds_left) line += text(", %.0f s left", std::fmax(*s.seconds_left, 0.0));
  if (!s.operator_phase.empty()) line += "  operator: " + s.operator_phase;
  return line;
}

}  // namespace

std::string render(const ConsoleSnapshot& s, int width, bool color, int rows) {
  width = std::clamp(width, kWidthMin, kWidthMax);
  Page page(width, color);
  page.whole(clock_line(s), Tone::kDim);
  page.blank();
  page.whole(s.shown.sentence, tone_of(s.view.state));
  if (!s.notice.empty()) page.whole(s.notice, Tone::kWarn);
  for (const std::string& sentence : reduced_in_words(s.view.reduced | s.view.far.reduced))
    page.whole("reduced protection: " + sentence, Tone::kWarn);
  page.blank();
  page.line("state", state_line(s), tone_of(s.view.state));
  page.line("link", link_line(s.link), s.view.silent ? Tone::kWarn : Tone::kPlain);
  page.line("datagrams", datagrams_line(s.link), Tone::kPlain, Weight::kDetail);
  page.line("mode", mode_line(s.view));
  page.blank();
  page.line("hand at", millimetres(s.view.p_MH), Tone::kPlain, Weight::kDetail);
  page.line("goal", millimetres(s.view.goal_m) + " from anchor", Tone::kPlain, Weight::kDetail);
  page.line("forecast", millimetres(s.view.forecast.p) + " when the robot receives it", Tone::kPlain,
            Weight::kDetail);
  page.line("tool at", tool_line(s), Tone::kPlain, Weight::kDetail);
  page.blank();
  page.line("stiffness", stiffness_line(s), s.view.in_contact ? Tone::kGood : Tone::kPlain);
  page.line("contact", contact_line(s), s.view.in_contact ? Tone::kPlain : Tone::kDim);
  add_forces(page, s, width);
  page.line("energy",
            text("%+.2f mJ into the handle, minimum %+.2f mJ", s.view.port_energy_j * 1e3,
                 s.view.port_energy_min_j * 1e3),
            Tone::kPlain, Weight::kDetail);
  page.blank();
  add_clamps(page, s.shown.limits);
  page.line("loop", rejected_line(s), s.late_ticks > 0 ? Tone::kWarn : Tone::kDim, Weight::kDetail);
  if (s.show_keys) {
    page.blank();
    if (!s.pad_keys.empty()) page.whole(s.pad_keys, Tone::kDim);
    page.whole(key_line(), Tone::kDim);
  }
  return page.take(static_cast<std::size_t>(std::max(rows, 4)));
}

std::string render_line(const ConsoleSnapshot& s) {
  std::string line = text("%6.1f s  %s", s.seconds, std::string(state_in_words(s.view.state)).c_str());
  line += s.link.rtt_s ? text("  rtt %.3f s", *s.link.rtt_s) : "  rtt -";
  line += text("  loss %.1f %%  %s", s.link.loss * 100.0, std::string(mode_in_words(s.view.mode)).c_str());
  line += text("  hand %+.1f %+.1f %+.1f mm", s.view.p_MH.x() * 1e3, s.view.p_MH.y() * 1e3,
               s.view.p_MH.z() * 1e3);
  line += text("  %.2f N  %.2f N/mm", s.view.F_H_M.force.norm(), s.view.stiffness_n_per_m * 1e-3);
  return line.substr(0, kPlainColumns);
}

std::string render_event(const ConsoleSnapshot& s) {
  const std::string begin = text("%6.1f s  ", s.seconds);
  std::string lines, rest = std::string(state_in_words(s.view.state)) + ": " + s.shown.sentence;
  if (!s.notice.empty()) rest += "; " + s.notice;
  const std::size_t room = kPlainColumns - std::min(begin.size(), kPlainColumns / 2);
  while (rest.size() > room) {
    const std::size_t space = rest.rfind(' ', room);
    const std::size_t end = space == std::string::npos || space == 0 ? room : space;
    lines += rest.substr(0, end) + "\n          ";
    rest.erase(0, end == space ? end + 1 : end);
  }
  return begin + lines + rest;
}

}  // namespace longreach
