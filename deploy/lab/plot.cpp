#include "deploy/lab/plot.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace longreach {
namespace {

// Okabe and Ito (2008): colours that can be distinguished with colour blindness.
constexpr std::array<std::string_view, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                      "#cc79a7", "#e69f00", "#56b4e9"};

constexpr double kTitle_px = 50.0, kAxis_px = 45.0;

double height_px(const Plot& plot) {
  return kTitle_px + plot.panel_px * static_cast<double>(plot.panels.size()) + kAxis_px;
}

/// Quotes a text for gnuplot.
std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

std::string style_of(const Curve& curve) {
  if (!curve.low.empty()) return "yerrorlines lw 1.6 pt " + std::to_string(curve.mark);
  if (!curve.points) return curve.dashed ? "lines lw 1.6 dt 2" : "lines lw 1.6";
  const std::string size = curve.size > 0.0 ? " lw 2 ps " + std::to_string(curve.size) : "";
  return "points pt " + std::to_string(curve.mark) + size;
}

void write_panel(std::ostream& out, const Plot& plot, const Panel& panel, std::size_t i) {
  const bool last = i + 1 == plot.panels.size();
  const double height = plot.panel_px / height_px(plot);
  const double top = 1.0 - (kTitle_px + static_cast<double>(i) * plot.panel_px) / height_px(plot);
  out << "set tmargin at screen " << top << "\nset bmargin at screen " << top - 0.86 * height << '\n';
  out << "set ylabel " << in_quotes(panel.y_label) << " offset 0.5,0\n";
  out << (last ? "set format x '%g'\nset xlabel " + in_quotes(plot.x_label) + "\n"
               : "set format x ''\nset xlabel\n");
  out << "set yrange [*:*]\nset pointsize 0.7\n" << panel.extra << "\nplot ";
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const Curve& curve = panel.curves[c];
    const auto y = [&](const std::string& column) {
      out << ":(column('" << column << "')*" << curve.factor << ")";
    };
    out << (c ? ", " : "") << "'" << (curve.csv.empty() ? plot.csv : curve.csv) << ".csv' using (column('"
        << plot.x_column << "')*" << plot.x_factor << ")";
    y(curve.column);
    if (!curve.low.empty()) {
      y(curve.low);
      y(curve.high);
    }
    out << (curve.scales ? "" : " noautoscale") << " with " << style_of(curve) << " lc rgb '"
        << kColours[(curve.colour < 0 ? c : static_cast<std::size_t>(curve.colour)) % kColours.size()]
        << "' title " << in_quotes(curve.title);
  }
  out << '\n';
}

}  // namespace

std::string draw(const std::filesystem::path& folder, const Plot& plot) {
  const std::filesystem::path script = folder / (plot.name + ".gp");
  {
    std::ofstream out(script, std::ios::trunc);
    out << "set terminal svg size 900," << height_px(plot) << " dynamic font 'sans,13' background '#ffffff'\n"
        << "set output '" << plot.name << ".svg'\nset datafile separator ','\n"
        << "set title\nset grid lc rgb '#dddddd'\nset border 3 lc rgb '#666666'\nset tics nomirror\n"
        << "set key outside right top samplen 1.5 width -2\nset lmargin at screen 0.10\nset rmargin at "
           "screen 0.78\n"
        << "set label 1 " << in_quotes(plot.title) << " at screen 0.10,"
        << 1.0 - 0.55 * kTitle_px / height_px(plot) << " font 'sans,15'\n"
        << "set multiplot\n";
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
      write_panel(out, plot, plot.panels[i], i);
      out << "unset label 1\n";
    }
    out << "unset multiplot\n";
    if (!out) return "cannot write " + script.string();
  }
  // The folder is passed as the working directory, so that any name is safe.
  std::error_code error;
  const std::filesystem::path before = std::filesystem::current_path(error);
  std::filesystem::current_path(folder, error);
  if (error) return "cannot enter " + folder.string();
  const int status = std::system(("gnuplot " + plot.name + ".gp 2> gnuplot.log").c_str());
  std::filesystem::current_path(before, error);
  if (status != 0) return "gnuplot failed, so a plot is missing; see " + (folder / "gnuplot.log").string();
  std::filesystem::remove(folder / "gnuplot.log", error);
  return "";
}

}  // namespace longreach
