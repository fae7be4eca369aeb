#include "tests/extremes/extremes_table.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "common/text/number_text.hpp"

namespace longreach {
namespace {

constexpr int kLeft_px = 400, kCell_px = 80, kRow_px = 36, kTop_px = 76, kColumns = 8;

struct Look {
  const char* word;
  const char* fill;
  const char* ink;
};
// Okabe and Ito (2008), told apart by the colour-blind; the words do without colours.
Look look_of(ExtremeOutcome outcome) {
  if (outcome == ExtremeOutcome::kStable) return {"stable", "#cfe3f1", "#003a5c"};
  if (outcome == ExtremeOutcome::kRefused) return {"refused", "#f7e3b0", "#5c4400"};
  return {"BAD", "#d55e00", "#ffffff"};
}

std::string escaped(const std::string& text, bool xml) {
  std::string out;
  for (const char c : text) {
    if (xml && c == '<')
      out += "&lt;";
    else if (xml && c == '&')
      out += "&amp;";
    else if (!xml && c == '"')
      out += "\"\"";
    else
      out += c;
  }
  return out;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return value == 0.0 ? "0" : text;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::trunc);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string() + ": check free disk space");
}

std::string text_at(int x, int y, const std::string& style, const std::string& text) {
  return "<text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" " + style + ">" +
         escaped(text, true) + "</text>\n";
}

std::string cell_at(int x, int y, const ExtremeCell& cell, const ExtremeResult& result) {
  const Look look = look_of(result.outcome);
  const std::string number =
      result.outcome == ExtremeOutcome::kStable ? short_number(result.accuracy) : look.word;
  const std::string ink = std::string("text-anchor=\"middle\" fill=\"") + look.ink + "\" ";
  return "<rect x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" width=\"" +
         std::to_string(kCell_px - 3) + "\" height=\"" + std::to_string(kRow_px - 4) + "\" rx=\"3\" fill=\"" +
         look.fill + "\"><title>" +
         escaped(cell.value + ": " + (result.words.empty() ? number : result.words), true) +
         "</title></rect>\n" + text_at(x + kCell_px / 2 - 1, y + 13, ink + "font-size=\"11\"", cell.value) +
         text_at(x + kCell_px / 2 - 1, y + 27, ink + "font-size=\"12\" font-weight=\"bold\"", number);
}

std::string csv(const std::vector<ExtremeRow>& rows, const std::vector<std::vector<ExtremeResult>>& results) {
  std::string text = "quantity,value,outcome,accuracy,measure,message\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < results[r].size(); ++c) {
      const ExtremeResult& result = results[r][c];
      const bool stable = result.outcome == ExtremeOutcome::kStable;
      const auto quoted = [](const std::string& field) { return "\"" + escaped(field, false) + "\""; };
      text += quoted(rows[r].quantity) + "," + quoted(rows[r].cells[c].value) + "," +
              look_of(result.outcome).word + "," + (stable ? format_number(result.accuracy) : "") + "," +
              quoted(rows[r].measure) + "," + quoted(result.words) + "\n";
    }
  }
  return text;
}

std::string svg(const std::vector<ExtremeRow>& rows, const std::vector<std::vector<ExtremeResult>>& results) {
  std::string body;
  int y = kTop_px;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    body += text_at(14, y + 14, "font-size=\"13\"", rows[r].quantity);
    body += text_at(14, y + 28, "font-size=\"11\" fill=\"#666666\"", rows[r].measure);
    for (std::size_t c = 0; c < results[r].size(); ++c) {
      if (c > 0 && c % kColumns == 0) y += kRow_px;
      body +=
          cell_at(kLeft_px + static_cast<int>(c % kColumns) * kCell_px, y, rows[r].cells[c], results[r][c]);
    }
    y += kRow_px;
  }
  const std::string width = std::to_string(kLeft_px + kColumns * kCell_px + 14),
                    height = std::to_string(y + 10);
  std::string head =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
      "\" viewBox=\"0 0 " + width + " " + height +
      "\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  head += text_at(14, 28, "font-size=\"17\"", "Every quantity at its extremes");
  head += text_at(
      14, 50, "font-size=\"12\" fill=\"#666666\"",
      "Above in a cell the value, below how accurate it is there (grey: what that number is); refused: "
      "with a message, see extremes.csv");
  return head + body + "</svg>\n";
}

}  // namespace

void write_extremes(const std::filesystem::path& folder, const std::vector<ExtremeRow>& rows,
                    const std::vector<std::vector<ExtremeResult>>& results) {
  write(folder / "extremes.csv", csv(rows, results));
  write(folder / "extremes.svg", svg(rows, results));
}

}  // namespace longreach
