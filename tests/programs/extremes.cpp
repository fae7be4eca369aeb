// Every quantity at its extremes, by the laboratory (tests/extremes/extremes.hpp).

#include "tests/extremes/extremes.hpp"

#include "tests/programs/verification.hpp"

int main(int argc, char** argv) {
  using namespace longreach;
  const Experiment extremes{
      "extremes",
      "Every quantity at its extremes, from 1 N/m to 1e9, 1 g to 100 t, 1 mm to 20 m: stable, or refused?",
      "", run_extremes, extremes_plots};
  CLI::App app{
      std::string(extremes.summary) +
      "\n\nExit status: 0 if every cell has the expected outcome, 1 if a cell is bad, 2 if an option is "
      "invalid."};
  app.name("extremes");
  VerificationOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    const std::vector<Metric> metrics = verify(extremes, options);
    if (value_of(metrics, "bad") > 0.0) throw std::runtime_error("a cell is bad");
    if (value_of(metrics, "controls_bad") < value_of(metrics, "controls"))
      throw std::runtime_error("a control, which is wrong, came out good");
  });
}
