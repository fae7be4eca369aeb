// Other people's libraries beside ours, by the laboratory (tests/peers/peers.hpp).

#include "tests/peers/peers.hpp"

#include <cmath>

#include "tests/programs/verification.hpp"

int main(int argc, char** argv) {
  using namespace longreach;
  const Experiment peers{
      "peers", "The time of KDL, Ceres Solver, Simbody and MuJoCo relative to ours for the same problem.", "",
      run_peers, [] { return std::vector<Plot>{}; }};
  CLI::App app{std::string(peers.summary) +
               "\n\nExit status: 0 on success, 1 on failure, 2 if an option is invalid."};
  app.name("peers");
  VerificationOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    for (const Metric& m : verify(peers, options))
      if (!std::isfinite(m.value)) throw std::runtime_error(m.name + " was not measured");
  });
}
