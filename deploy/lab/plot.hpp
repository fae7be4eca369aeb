#pragma once
// SVG plots drawn by gnuplot: stacked panels over a common x axis, each with its own y axis.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct Curve {
  std::string column;         // column of the CSV file
  std::string title;          // title in the legend; empty: not in the legend
  double factor = 1.0;        // conversion factor from the unit of the column to that of the axis
  bool points = false;        // draw points instead of a line
  int mark = 7;               // gnuplot's point type
  int colour = -1;            // index in the palette; negative: the index of the curve in its panel
  double size = 0.0;          // size of the points; 0: default of the panel
  std::string csv{};          // name of a separate trace; empty: the trace of the plot
  std::string low{}, high{};  // columns with the ends of the error bars; empty: no error bars
  bool dashed = false;        // draw a dashed line, for a curve on top of another one
  bool scales = true;         // the range of the y axis includes the curve
};

struct Panel {
  std::string y_label;
  std::vector<Curve> curves;
  std::string extra;  // further gnuplot commands, e.g. a y range
};

struct Plot {
  std::string name;  // file name without extension
  std::string csv;   // name of the trace without extension
  std::string title;
  std::string x_column;
  std::string x_label;
  double x_factor = 1.0;  // conversion factor from the unit of the column to that of the axis
  std::vector<Panel> panels;
  double panel_px = 190.0;  // height of a panel
};

/// Writes FOLDER/NAME.gp and FOLDER/NAME.svg. Returns a one-sentence error message if gnuplot is missing or
/// fails, otherwise an empty string.
std::string draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace longreach
