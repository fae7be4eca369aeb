// The plots of the delay sweep.

#include "deploy/lab/delay/delay_grid.hpp"

namespace longreach {
namespace {

constexpr std::array kMarks = {7, 5, 9, 11, 13, 7};  // gnuplot's filled point types

Plot displayable_plot() {
  Panel panel{"displayable stiffness (N/mm)",
              {},
              "set logscale xy\nset xrange [0.02:10]\nset yrange [0.001:10]\nset format y '%g'"};
  for (std::size_t i = 0; i < kLawNames.size(); ++i) {
    panel.curves.push_back({.column = std::string(kLawNames[i].column) + "_n_per_m",
                            .title = std::string(kLawNames[i].title),
                            .factor = 1e-3,
                            .points = true,
                            .mark = kMarks[i],
                            .colour = static_cast<int>(i)});
  }
  const auto line = [&](const char* column, const char* title, int colour) {
    panel.curves.push_back({.column = column, .title = title, .factor = 1e-3, .colour = colour});
  };
  line("direct_line_n_per_m", "limit: delay margin", 0);
  line("position_position_line_n_per_m", "limit: coupling and wall", 1);
  line("wave_line_n_per_m", "limit: 2 b/RTT and wall", 2);
  line("wall_n_per_m", "wall, 5 N/mm", 5);
  return {
      .name = "displayable",
      .csv = "displayable",
      .title = "Maximum stable displayed stiffness versus round-trip time (light hand, walls up to 5 N/mm)",
      .x_column = "rtt_s",
      .x_label = "round-trip time (s)",
      .panels = {panel},
      .panel_px = 430.0};
}

Plot wall_plot(const std::string& wall, const std::string& title) {
  const std::string axis = "set logscale x\nset xrange [0.02:10]\n";
  Panel shown{
      "displayed / true stiffness", {}, axis + "set logscale y\nset yrange [0.003:2]\nset format y '%g'"};
  Panel given{"energy returned to the operator (mJ)",
              {},
              axis +
                  "set logscale y\nset yrange [1e-4:*]\nset format y "
                  "'10^{%L}'"};
  for (std::size_t i = 0; i < kLawNames.size(); ++i) {
    Curve curve{.column = std::string(kLawNames[i].column),
                .title = std::string(kLawNames[i].title),
                .points = true,
                .mark = kMarks[i]};
    shown.curves.push_back(curve);
    curve.column += "_given_mj";
    given.curves.push_back(curve);
  }
  const auto limit = [&](const char* column, const char* name, int colour) {
    shown.curves.push_back({.column = column, .title = name, .colour = colour, .csv = "limits_" + wall});
  };
  limit("direct", "limit: delay margin", 0);
  limit("position_position", "limit: coupling", 1);
  limit("wave", "limit: 2 b/RTT", 2);
  return {.name = "wall_" + wall,
          .csv = wall + "_n_per_m",
          .title = "A wall of " + title + " and a light hand (cases with a limit cycle are not plotted)",
          .x_column = "rtt_s",
          .x_label = "round-trip time (s)",
          .panels = {shown, given},
          .panel_px = 230.0};
}

}  // namespace

std::vector<Plot> delay_sweep_plots() {
  return {displayable_plot(), wall_plot("200", "0.2 N/mm"), wall_plot("500", "0.5 N/mm"),
          wall_plot("1000", "1 N/mm"), wall_plot("5000", "5 N/mm")};
}

}  // namespace longreach
