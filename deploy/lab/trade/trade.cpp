// Every stage that can trade speed for accuracy: its methods, their Pareto front, and the position of the
// defaults.

#include "deploy/lab/trade/trade.hpp"

#include <algorithm>
#include <cmath>

#include "deploy/lab/trace.hpp"

namespace longreach {
namespace {

const std::vector<TradeStage>& stages() {
  static const std::vector<TradeStage> all = {
      trade_spherical_forward(), trade_delta_forward(),     trade_arm_inverse(),
      trade_contact(),           trade_estimator(),         trade_sample_rate(),
      trade_send_rate(),         trade_playout(),           trade_deadband(),
      trade_precision(),         trade_accuracy_tracking(), trade_accuracy_stiffness()};
  return all;
}

std::string trace_name(const TradeStage& stage) { return "trade_" + std::string(stage.name); }

/// One row per point. The points of the front come first, ordered by cost, so that a line can join them. The
/// error is in the column of its series, so that each series is drawn with its own mark.
void write(const ExperimentRun& run, const TradeStage& stage, const std::vector<TradePoint>& points) {
  struct Row {
    const TradePoint* point;
    bool on_front;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < points.size(); ++i) rows.push_back({&points[i], on_front(points, i)});
  std::ranges::stable_sort(rows, {}, [](const Row& r) { return std::pair(!r.on_front, r.point->cost); });
  std::vector<std::string_view> columns{"cost", "instructions", "front", "standard"};
  columns.insert(columns.end(), stage.series.begin(), stage.series.end());
  Trace trace(run.out, trace_name(stage), columns);
  for (const auto& [p, front] : rows) {
    const double shown = std::max(p->error, 1e-17);  // on a logarithmic axis
    std::vector<double> row{p->cost, p->instructions, front ? shown : NAN, p->standard ? shown : NAN};
    for (const std::string_view series : stage.series) row.push_back(p->series == series ? shown : NAN);
    trace.row(row);
  }
  trace.close();
}

std::string metric_name(const TradeStage& stage, const TradePoint& p) {
  std::string name = std::string(stage.name) + "_" + p.series + (p.setting.empty() ? "" : "_" + p.setting);
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

void add_metrics(std::vector<Metric>& metrics, const TradeStage& stage,
                 const std::vector<TradePoint>& points) {
  bool standard_on_front = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TradePoint& p = points[i];
    const std::string name = metric_name(stage, p);
    metrics.push_back({name + "_cost", p.cost, std::string(stage.cost_unit), stage.of_machine});
    if (std::isfinite(p.instructions)) metrics.push_back({name + "_instructions", p.instructions, "", true});
    metrics.push_back({name + "_error", p.error, std::string(stage.error_unit)});
    standard_on_front = standard_on_front || (p.standard && on_front(points, i));
  }
  metrics.push_back({std::string(stage.name) + "_default_on_front", standard_on_front ? 1.0 : 0.0, "", true});
}

Plot plot_of(const TradeStage& stage) {
  constexpr int kMarks[] = {7, 5, 9, 11, 13, 4, 6, 8, 10, 12};
  std::vector<Curve> curves{{"front", "front", 1.0, false, 7, 5}};
  for (std::size_t i = 0; i < stage.series.size(); ++i) {
    std::string title(stage.series[i]);
    std::ranges::replace(title, '_', ' ');
    curves.push_back({std::string(stage.series[i]), title, 1.0, true, kMarks[i % std::size(kMarks)],
                      static_cast<int>(i % 5)});
  }
  curves.push_back({"standard", "default", 1.0, true, 6, 1, 2.4});
  const std::string error = std::string(stage.error) + " (" + std::string(stage.error_unit) + ")";
  return {
      .name = trace_name(stage),
      .csv = trace_name(stage),
      .title = std::string(stage.title),
      .x_column = "cost",
      .x_label = std::string(stage.cost) + " (" + std::string(stage.cost_unit) + ")",
      .panels = {{error, curves,
                  "set logscale xy\nset format y '%g'\nset offsets graph 0.05, graph 0.05, graph 0.08, graph "
                  "0.05\nset pointsize 1.2"}},
      .panel_px = 300.0};
}

}  // namespace

bool on_front(const std::vector<TradePoint>& points, std::size_t which) {
  const TradePoint& self = points[which];
  return std::ranges::none_of(points, [&self](const TradePoint& p) {
    return p.cost <= self.cost && p.error <= self.error && (p.cost < self.cost || p.error < self.error);
  });
}

std::vector<Plot> trade_plots() {
  std::vector<Plot> plots;
  for (const TradeStage& stage : stages()) plots.push_back(plot_of(stage));
  return plots;
}

std::vector<Metric> run_trade(const ExperimentRun& run) {
  std::vector<Metric> metrics;
  double on = 0.0, done = 0.0;
  for (const TradeStage& stage : stages()) {
    const std::vector<TradePoint> points = stage.measure(run);
    write(run, stage, points);
    add_metrics(metrics, stage, points);
    on += metrics.back().value;
    if (run.progress) run.progress(++done / static_cast<double>(stages().size()));
  }
  metrics.push_back({"stages", static_cast<double>(stages().size()), ""});
  metrics.push_back({"defaults_on_front", on, "", true});
  return metrics;
}

}  // namespace longreach
