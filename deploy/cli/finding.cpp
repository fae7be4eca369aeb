#include "deploy/cli/finding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "deploy/cli/json_text.hpp"
#include "deploy/cli/status_text.hpp"

namespace longreach {
namespace {

constexpr std::size_t kBarWidth = 40;
constexpr std::size_t kTextColumn = 28;  // of the result

std::string_view name_of(FindingVerdict verdict) {
  switch (verdict) {
    case FindingVerdict::kOk:
      return "ok";
    case FindingVerdict::kWarning:
      return "warning";
    case FindingVerdict::kFailure:
      break;
  }
  return "failure";
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

/// Wraps a text at spaces, so that its lines fit a terminal with 110 columns.
std::string wrapped(const std::string& text, std::size_t column) {
  constexpr std::size_t kColumns = 110;
  std::string out;
  std::size_t at = column;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (begin != 0 && at + 1 + end - begin > kColumns) {
      out += "\n" + std::string(column, ' ');
      at = column;
    } else if (begin != 0) {
      out += ' ';
      ++at;
    }
    out += text.substr(begin, end - begin);
    at += end - begin;
    begin = end + 1;
  }
  return out;
}

std::string bars_text(const Histogram& histogram) {
  std::uint64_t all = 0, most = 1;
  for (const auto& bar : histogram.bars) {
    all += bar.count;
    most = std::max(most, bar.count);
  }
  std::string out;
  for (const auto& bar : histogram.bars) {
    const std::size_t filled = (bar.count * kBarWidth + most - 1) / most;
    std::array<char, 32> share{};
    std::snprintf(share.data(), share.size(), "%5.1f %%",
                  100.0 * static_cast<double>(bar.count) / static_cast<double>(all));
    out += padded("", kTextColumn) + padded("to " + with_unit(bar.up_to_s, "s"), 12) +
           (bar.count == 0 ? "    0    " : std::string(share.data()) + "  ") + std::string(filled, '#') +
           "\n";
  }
  return out;
}

/// Bounds of 1, 2 and 5 per decade, or equal steps if all values are close to each other.
std::vector<double> edges(double least, double most) {
  constexpr double kBarsMax = 8.0, kFinest = 0.01;
  std::vector<double> out, steps;
  for (int decade = -6; decade <= 3; ++decade)
    for (const double step : {1.0, 2.0, 5.0}) steps.push_back(step * std::pow(10.0, decade));
  if (most > 2.5 * least) return steps;
  for (const double step : steps) {
    if (most - least > kBarsMax * step || step < kFinest * least) continue;
    for (double k = std::floor(least / step); k * step < most + step; k += 1.0) out.push_back(k * step);
    break;
  }
  return out;
}

std::string plural(std::uint64_t count, const char* one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace

Histogram histogram_of(const std::vector<double>& times_s) {
  Histogram out;
  if (times_s.empty()) return out;
  const auto [least, most] = std::minmax_element(times_s.begin(), times_s.end());
  double before = 0.0;
  for (const double edge : edges(*least, *most)) {
    if (*least <= edge && before < *most) {
      const auto in = [&](double t) { return t > before && t <= edge; };
      out.bars.push_back(
          {edge, static_cast<std::uint64_t>(std::count_if(times_s.begin(), times_s.end(), in))});
    }
    before = edge;
  }
  return out;
}

std::uint64_t count(const Diagnosis& diagnosis, FindingVerdict verdict) {
  std::uint64_t out = 0;
  for (const Section& section : diagnosis)
    for (const Finding& finding : section.findings) out += finding.verdict == verdict ? 1U : 0U;
  return out;
}

std::string diagnosis_text(const Section& section) {
  std::string out = section.title + "\n";
  for (const Finding& finding : section.findings) {
    out += "  " + padded(std::string(name_of(finding.verdict)), 9) + padded(finding.what, kTextColumn - 12) +
           " " + wrapped(finding.text, kTextColumn) + "\n";
    if (!finding.advice.empty())
      out += padded("", kTextColumn - 3) + "-> " + wrapped(finding.advice, kTextColumn) + "\n";
    out += bars_text(finding.histogram);
  }
  return out;
}

std::string diagnosis_summary(const Diagnosis& diagnosis) {
  const std::uint64_t ok = count(diagnosis, FindingVerdict::kOk);
  return std::to_string(ok) + " ok, " + plural(count(diagnosis, FindingVerdict::kWarning), "warning") + ", " +
         plural(count(diagnosis, FindingVerdict::kFailure), "failure");
}

std::string diagnosis_json(const Diagnosis& diagnosis) {
  std::string out = "{\"failures\":" + std::to_string(count(diagnosis, FindingVerdict::kFailure)) +
                    ",\"warnings\":" + std::to_string(count(diagnosis, FindingVerdict::kWarning)) +
                    ",\"findings\":[";
  const char* comma = "";
  for (const Section& section : diagnosis) {
    for (const Finding& finding : section.findings) {
      out += std::string(comma) + "{\"section\":" + json_string(section.title) +
             ",\"what\":" + json_string(finding.what) +
             ",\"verdict\":" + json_string(name_of(finding.verdict)) +
             ",\"text\":" + json_string(finding.text) + ",\"advice\":" + json_string(finding.advice) +
             ",\"histogram\":[";
      const char* between = "";
      for (const auto& bar : finding.histogram.bars) {
        std::array<char, 80> one{};
        std::snprintf(one.data(), one.size(), "%s{\"up_to_s\":%g,\"count\":%llu}", between, bar.up_to_s,
                      static_cast<unsigned long long>(bar.count));
        out += one.data();
        between = ",";
      }
      out += "]}";
      comma = ",";
    }
  }
  return out + "]}";
}

}  // namespace longreach
