#include "deploy/lab/report/page.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "deploy/lab/report/answer.hpp"

namespace longreach {
namespace {

constexpr std::string_view kStyle = R"(
:root { --ink: #1b1f24; --soft: #57606a; --line: #d8dee4; --paper: #ffffff; --tint: #f6f8fa; --link: #0b5cad; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --soft: #9aa4af; --line: #30363d; --paper: #0f1419; --tint: #171c22; --link: #6cb6ff; }
}
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.5rem 6rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, sans-serif; }
a { color: var(--link); text-decoration: none; } a:hover { text-decoration: underline; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; }
h2 { font-size: 1.25rem; margin: 3rem 0 .3rem; padding-top: 1rem; border-top: 1px solid var(--line); }
p { margin: .4rem 0; } .soft { color: var(--soft); } .failed { color: #c62828; font-weight: 600; }
table { border-collapse: collapse; width: 100%; margin: 1rem 0; font-size: .92rem; }
th, td { text-align: left; vertical-align: top; padding: .35rem .7rem .35rem 0; border-bottom: 1px solid var(--line); }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th.number { text-align: right; }
code { background: var(--tint); padding: .1rem .35rem; border-radius: 4px; font-size: .88rem; }
img { width: 100%; background: #ffffff; border-radius: 6px; margin: .6rem 0; border: 1px solid var(--line); }
details { margin: .6rem 0; } summary { cursor: pointer; color: var(--link); }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
  }
  return out;
}

std::string answer_of(const ReportChapter& c) {
  return c.failure.empty() ? answer(c.experiment->answer, c.metrics) : std::string();
}

std::string overview(const std::vector<ReportChapter>& chapters) {
  std::string html = "<table>\n<tr><th>experiment</th><th>question</th><th>answer</th></tr>\n";
  for (const ReportChapter& c : chapters) {
    const std::string name = escaped(c.experiment->name);
    html += "<tr><td><a href=\"#" + name + "\">" + name + "</a></td><td>" + escaped(c.experiment->summary) +
            "</td><td>" +
            (c.failure.empty() ? escaped(answer_of(c)) : "<span class=\"failed\">failed</span>") +
            "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string metrics_table(const std::vector<Metric>& metrics) {
  std::string html =
      "<details><summary>" + std::to_string(metrics.size()) +
      " metrics</summary>\n<table>\n<tr><th>metric</th><th class=\"number\">value</th><th>unit</th></tr>\n";
  for (const Metric& m : metrics) {
    html += "<tr><td>" + escaped(m.name) +
            (m.of_machine ? " <span class=\"soft\">(depends on the machine)</span>" : "") +
            "</td><td class=\"number\">" + number(m.value) + "</td><td>" + escaped(m.unit) + "</td></tr>\n";
  }
  return html + "</table></details>\n";
}

std::string chapter(const ReportChapter& c) {
  const std::string name = escaped(c.experiment->name);
  std::string html = "<h2 id=\"" + name + "\">" + name + "</h2>\n<p>" + escaped(c.experiment->summary);
  if (!c.experiment->figure.empty())
    html +=
        " <span class=\"soft\">Reproduces " + escaped(c.experiment->figure) + " of Liu et al. (2019).</span>";
  html += "</p>\n";
  if (!c.failure.empty()) return html + "<p class=\"failed\">Failed: " + escaped(c.failure) + "</p>\n";
  if (const std::string said = answer_of(c); !said.empty()) html += "<p><b>" + escaped(said) + "</b></p>\n";
  for (const ReportPicture& picture : c.pictures) {
    html += "<img alt=\"" + escaped(picture.title) + "\" src=\"data:image/svg+xml;base64," +
            base64(picture.svg) + "\">\n";
  }
  html += metrics_table(c.metrics);
  return html + "<p class=\"soft\"><code>" + escaped(c.command) + "</code>, configuration " +
         escaped(c.config) + "</p>\n";
}

}  // namespace

std::string report_page(const ReportHead& head, const std::vector<ReportChapter>& chapters) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>longreach: results</title>\n<style>";
  html += kStyle;
  html += "</style></head><body>\n<h1>longreach: results</h1>\n<p class=\"soft\">commit " +
          escaped(head.commit) + ", seed " + std::to_string(head.seed) + ", " + escaped(head.size) +
          ". The experiments run in virtual time: the same commit, configuration and seed give the "
          "same metrics, except for those that depend on the machine.</p>\n";
  html += overview(chapters);
  for (const ReportChapter& c : chapters) html += chapter(c);
  return html + "</body></html>\n";
}

std::string report_table(const std::vector<ReportChapter>& chapters) {
  std::string text = "| `longreach-lab run ...` | question | answer |\n|---|---|---|\n";
  for (const ReportChapter& c : chapters) {
    const std::string said = answer_of(c);
    if (said.empty()) continue;
    text += "| `" + std::string(c.experiment->name) + "` | " + std::string(c.experiment->summary);
    if (!c.experiment->figure.empty()) text += " (" + std::string(c.experiment->figure) + ")";
    text += " | " + said + " |\n";
  }
  return text;
}

}  // namespace longreach
