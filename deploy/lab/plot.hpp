#pragma once
// SVG plots by gnuplot: stacked panels over a common x axis, each with its own y axis.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct Curve {
  std::string column;         // of the CSV file
  std::string title;          // in the legend; empty: omitted
  double factor = 1.0;        // from the unit of the column to that of the axis
  bool points = false;        // instead of a line
  int mark = 7;               // gnuplot's point type
  int colour = -1;            // index in the palette; negative: that of the curve in its panel
  double size = 0.0;          // of the points; 0: the panel's
  std::string csv{};          // separate trace; empty: that of the plot
  std::string low{}, high{};  // columns of error bars; empty: none
  bool dashed = false;        // for a curve on top of another one
  bool scales = true;         // included in the range of the y axis
};

struct Panel {
  std::string y_label;
  std::vector<Curve> curves;
  std::string extra;  // further gnuplot commands, e.g. a y range
};

struct Plot {
  std::string name;  // file name without ending
  std::string csv;   // name of the trace without ending
  std::string title;
  std::string x_column;
  std::string x_label;
  double x_factor = 1.0;  // from the unit of the column to that of the axis
  std::vector<Panel> panels;
  double panel_px = 190.0;  // height of a panel
};

/// Writes FOLDER/NAME.gp and FOLDER/NAME.svg. Returns a sentence if gnuplot is missing or fails, otherwise an
/// empty string.
std::string draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace longreach
