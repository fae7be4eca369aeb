#pragma once
// SVG plots by gnuplot: panels one above the other over a common x axis, each with its own y axis.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct Curve {
  std::string column;         // of the CSV file
  std::string title;          // in the legend; empty: not there
  double factor = 1.0;        // from the column's unit to the axis's
  bool points = false;        // instead of a line
  int mark = 7;               // gnuplot's point type
  int colour = -1;            // place in the palette; negative: that of the curve in its panel
  double size = 0.0;          // of the points; 0: the panel's
  std::string csv{};          // trace of its own; empty: the plot's
  std::string low{}, high{};  // columns of error bars; empty: none
  bool dashed = false;        // shows a curve that lies below it
  bool scales = true;         // the y axis holds all of it
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
  double x_factor = 1.0;  // from the column's unit to the axis's
  std::vector<Panel> panels;
  double panel_px = 190.0;  // height of a panel
};

/// Writes FOLDER/NAME.gp and FOLDER/NAME.svg. Returns a sentence when gnuplot is missing or fails, else
/// nothing.
std::string draw(const std::filesystem::path& folder, const Plot& plot);

}  // namespace longreach
