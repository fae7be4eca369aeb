// The whole loop in virtual time: what the hand feels through every named link. LONGREACH_FULL=1 runs the
// whole grid.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "common/config/config.hpp"
#include "deploy/lab/experiment.hpp"
#include "master/config/rendering_config.hpp"

namespace longreach::touch_test {
namespace {

using Values = std::map<std::string, double>;

ExperimentRun configured(const std::vector<std::string>& settings, std::uint64_t seed) {
  ExperimentRun run;
  run.config = configure(settings, LONGREACH_DEPLOY);
  run.seed = seed;
  return run;
}

Values touch(const std::vector<std::string>& settings, std::uint64_t seed) {
  Values values;
  for (const Metric& m : run_touch(configured(settings, seed))) values[m.name] = m.value;
  return values;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

struct Case {
  std::string profile;
  double stiffness_n_per_m;
  double scale;
  double exponent;
  std::uint64_t seed;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.profile << ' ' << c.stiffness_n_per_m << " N/m, k_scale " << c.scale << ", n " << c.exponent
             << ", seed " << c.seed;
}

bool full_size() {
  const char* full = std::getenv("LONGREACH_FULL");
  return full && std::string(full) == "1";
}

/// The whole grid, or every ninth of it, each time another combination.
std::vector<Case> grid() {
  std::vector<Case> cases;
  int i = 0;
  for (const char* profile : {"lab", "analog", "moon"}) {
    for (const double k : {500.0, 1000.0, 5000.0}) {
      for (const double scale : {0.2, 0.8, 1.0}) {
        for (const double n : {1.0, 1.5}) {
          for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            if (full_size() || i++ % 9 == 4) cases.push_back({profile, k, scale, n, seed});
          }
        }
      }
    }
  }
  return cases;
}

class Touch : public testing::TestWithParam<Case> {};

TEST_P(Touch, TheHandFeelsTheWallCalmlyWhereItIs) {
  const Case& c = GetParam();
  const Values v = touch({"profile=" + c.profile, "mapping.scale=" + std::to_string(c.scale),
                          "scene.material.wall.stiffness_n_per_m=" + std::to_string(c.stiffness_n_per_m),
                          "scene.material.wall.exponent=" + std::to_string(c.exponent)},
                         c.seed);
  // A wall that is stiffer where the hand works than the device can render is displayed as that, and named.
  const double due = std::min(v.at("reference_stiffness_n_per_m"), v.at("stiffness_max_n_per_m"));
  if (due < v.at("reference_stiffness_n_per_m")) EXPECT_EQ(v.at("stiffness_cut"), 1.0);
  EXPECT_NEAR(v.at("displayed_stiffness_n_per_m"), due, 0.05 * due);
  EXPECT_GE(v.at("displayed_span_s"), 4.0);
  EXPECT_EQ(v.at("probing_cycles_done"), 1.0);
  EXPECT_GE(v.at("port_energy_min_j"), -returned_most_j());
  EXPECT_LE(v.at("energy_drawdown_j"), 0.001);
  EXPECT_LE(v.at("force_rise_excess_n"), 0.0);  // it may fall by a little more: a surface that lies deeper
  EXPECT_LE(v.at("force_step_excess_n"), 0.1);
  EXPECT_LE(v.at("wall_registration_error_m"), 0.001);
  EXPECT_EQ(v.at("rejected_datagrams"), 0.0);
  EXPECT_EQ(v.at("rejected_values"), 0.0);
  EXPECT_EQ(v.at("false_holds"), 0.0);
  EXPECT_EQ(v.at("limit_violations"), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Grid, Touch, testing::ValuesIn(grid()));

/// Whatever the law: against a twin that did not get the report, in the same tick.
TEST(Touch, AStepOfTheForceByAReportIsMeasuredUnderEachLaw) {
  const Values naive = touch({"profile=moon", "rendering.law=NAIVE"}, 1);
  EXPECT_GT(naive.at("force_step_at_update_max_n"), 10.0);
  EXPECT_GT(naive.at("force_step_excess_n"), 10.0);
  const Values ours = touch({"profile=moon"}, 1);
  EXPECT_LT(ours.at("force_step_at_update_max_n"), 0.1);
}

/// The hand drives five times as far as the tool: when it learns of the wall, that is 25 mm behind it.
TEST(Touch, SoftWallIdentifiedLateIsRenderedAccurately) {
  for (std::uint64_t seed = 1; seed <= 30; seed += full_size() ? 1 : 5) {
    const Values v =
        touch({"profile=moon", "mapping.scale=0.2", "scene.material.wall.stiffness_n_per_m=500"}, seed);
    EXPECT_LT(v.at("displayed_stiffness_error"), 0.045) << "seed " << seed;
  }
}

TEST(Touch, IsTheSameWithASensorThatCarriesAToolAndHasABias) {
  const std::vector<std::string> sensor{
      "sensing.tool.mass_kg=4",    "sensing.tool.com_m=0.01, 0, 0.1", "sensing.gravity_m_per_s2=0, 0, -9.81",
      "sensing.force_bias_n=5",    "sensing.moment_bias_nm=0.5",      "sensing.force_resolution_n=0.02",
      "sensing.force_range_n=200", "sensing.bandwidth_hz=500",        "sensing.zero_s=0.2"};
  const Values v = touch(sensor, 3);
  EXPECT_LT(v.at("displayed_stiffness_error"), 0.05);
  EXPECT_LT(v.at("wall_registration_error_m"), 1e-3);
  EXPECT_EQ(v.at("false_holds"), 0.0);
}

// Small ones do not have the deflection of the fastest speed.
TEST(Touch, IsRightWithEveryShippedDevice) {
  for (const char* device : {"falcon", "paper"}) {
    for (const char* profile : {"lab", "moon"}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Values v = touch(
            {std::string("device_file=devices/") + device + ".txtpb", std::string("profile=") + profile},
            seed);
        EXPECT_LT(v.at("displayed_stiffness_error"), 0.05) << device << ' ' << profile << ' ' << seed;
        EXPECT_GT(v.at("probing_cycles_done"), 0.0) << device << ' ' << profile << ' ' << seed;
        EXPECT_EQ(v.at("false_holds"), 0.0) << device << ' ' << profile << ' ' << seed;
      }
    }
  }
}

// In position mode 110 mm of the handle, whose workspace ends at 40 and 30 mm.
TEST(Touch, ReachesAFarWallOfASmallDeviceWithTheClutch) {
  for (const char* device : {"falcon", "paper"}) {
    const Values v = touch({std::string("device_file=devices/") + device + ".txtpb",
                            "operator.rate_distance_m=0.05", "operator.approach_speed_m_per_s=0.006"},
                           1);
    EXPECT_LT(v.at("displayed_stiffness_error"), 0.05) << device;
    EXPECT_GT(v.at("probing_cycles_done"), 0.0) << device;
  }
}

/// Stiffer than command.guard_stiffness_n_per_m, and the hand slides on it a little.
TEST(Touch, SteelWallIsNotSensorFault) {
  for (const char* wall : {"5e4", "1e5", "1e6"}) {
    for (std::uint64_t seed = 1; seed <= (full_size() ? 30U : 5U); ++seed) {
      const Values v = touch({std::string("scene.material.wall.stiffness_n_per_m=") + wall}, seed);
      EXPECT_GT(v.at("probing_cycles_done"), 0.0) << wall << " N/m, seed " << seed;
      EXPECT_EQ(v.at("false_holds"), 0.0) << wall << " N/m, seed " << seed;
    }
  }
}

/// A run that meets nothing has no error of a stiffness, not even one of 1.
TEST(Touch, WithoutContactTheOutcomeSaysSo) {
  const ExperimentRun run = configured({"profile=lab", "scene_file=scenes/free.txtpb"}, 1);
  const std::vector<Metric> metrics = run_touch(run);
  EXPECT_EQ(outcome_of(metrics), "no contact");
  for (const Metric& m : metrics) {
    EXPECT_EQ(m.name.find("stiffness"), std::string::npos) << m.name;
    EXPECT_EQ(m.name.find("registration"), std::string::npos) << m.name;
  }
  EXPECT_NE(metrics_json("touch", run, metrics).find("\"outcome\": \"no contact\""), std::string::npos);
  EXPECT_EQ(outcome_of(run_touch(configured({"profile=lab"}, 1))), "");
}

/// Of a ball and a cylinder, met beside their middle: a plane there would be 0.2 to 1 mm off.
TEST(Touch, TheRegistrationErrorIsThatOfTheShape) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "longreach_shape.txtpb";
  for (const std::string shape : {"sphere { centre_m: [0.155, 0.005, 0] radius_m: 0.05 }",
                                  "cylinder { centre_m: [0.145, 0.004, 0] radius_m: 0.04 length_m: 0.3 }"}) {
    std::ofstream(file) << "material { name: 'm' stiffness_n_per_m: 1000 }\n"
                        << "surface { name: 's' material: 'm' " << shape << " }\n";
    for (const char* profile : {"lab", "moon"}) {
      const Values v = touch({std::string("profile=") + profile, "scene_file=" + file.string()}, 1);
      ASSERT_EQ(v.count("wall_registration_error_m"), 1U) << profile << ' ' << shape;
      EXPECT_LT(v.at("wall_registration_error_m"), 1e-4) << profile << ' ' << shape;
      EXPECT_GT(v.at("wall_registration_error_m"), 0.0) << profile << ' ' << shape;
      EXPECT_EQ(v.at("probing_cycles_done"), 1.0) << profile << ' ' << shape;
    }
  }
  std::filesystem::remove(file);
}

TEST(Touch, NaiveLawInjectsEnergySoTheCheckCanFail) {
  const Values v =
      touch({"profile=moon-relay", "scene.material.wall.stiffness_n_per_m=5000", "rendering.law=NAIVE"}, 1);
  EXPECT_LT(v.at("port_energy_min_j"), -0.1);
}

// A long burst of losses in the midst of rate mode: the hold leaves rate mode's centre at the handle, far from
// home.
TEST(Touch, AHoldInTheMidstOfRateModeIsGotOver) {
  constexpr std::uint64_t kSeeds = 100;
  Values touched;
  for (std::uint64_t seed = 1; seed <= kSeeds && !(touched["false_holds"] > 0.0); ++seed)
    touched = touch({"profile=moon-relay", "master.link.impairment.loss_burst=12"}, seed);
  ASSERT_GT(touched["false_holds"], 0.0) << "nothing was tried";
  EXPECT_GT(touched["probing_cycles_done"], 0.0);
  EXPECT_LT(touched["displayed_stiffness_error"], 0.05);
}

TEST(Touch, TheSameSeedGivesTheSameBytesAndAnotherDoesNot) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "longreach_touch_test";
  std::vector<std::string> traces;
  for (const std::uint64_t seed : {7U, 7U, 8U}) {
    ExperimentRun run = configured({"profile=analog"}, seed);
    run.out = folder / std::to_string(traces.size());
    std::filesystem::create_directories(run.out);
    run_touch(run);
    traces.push_back(text_of(run.out / "touch.csv"));
  }
  EXPECT_GT(traces[0].size(), 10000U);
  EXPECT_EQ(traces[0], traces[1]);
  EXPECT_NE(traces[0], traces[2]);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace longreach::touch_test
