#include "deploy/lab/networks/spherical_network_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/random.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/common/config/error_of.hpp"

namespace longreach::spherical_network_file_test {
namespace {

SphericalPerceptron drawn(Random& random) {
  SphericalPerceptron net;
  for (std::size_t u = 0; u < SphericalPerceptron::kUnits; ++u) {
    net.bias[u] = std::ldexp(random.normal(), static_cast<int>(random.uniform(-300.0, 300.0)));
    for (std::size_t i = 0; i < 3; ++i)
      net.in[i][u] = random.normal(), net.out[i][u] = 1e-9 * random.normal();
  }
  for (double& x : net.offset) x = random.normal();
  return net;
}

SphericalNetworkFile any_network() {
  Random random(11);
  const auto vector = [&] { return Vector3(random.normal(), random.normal(), random.normal()); };
  SphericalNetworkFile file{"any", {}, random.uniform(), random.uniform()};
  SphericalNetworkConfig& c = file.config;
  c.axes.alpha1 = random.uniform(), c.axes.alpha2 = random.uniform();
  for (int i = 0; i < 3; ++i)
    c.axes.u.row(i) = vector(), c.axes.v.row(i) = vector(), c.axes.w0.row(i) = vector();
  c.workspace = {vector(), exp_rotation(vector()), random.uniform(), random.uniform()};
  c.cells = {1, vector(), 0.25};
  c.rough = drawn(random);
  c.fine = {drawn(random)};
  return file;
}

bool same(const SphericalPerceptron& a, const SphericalPerceptron& b) {
  return a.in == b.in && a.bias == b.bias && a.out == b.out && a.offset == b.offset;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(SphericalNetworkFile, KeepsEveryBit) {
  const TemporaryFolder folder;
  const SphericalNetworkFile a = any_network();
  const SphericalNetworkFile b =
      load_spherical_network(folder.write("n.txtpb", spherical_network_text(a, "# x\n")));
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.error_max_rad, b.error_max_rad);
  EXPECT_EQ(a.error_rms_rad, b.error_rms_rad);
  EXPECT_EQ(a.config.axes.alpha1, b.config.axes.alpha1);
  EXPECT_EQ(a.config.axes.alpha2, b.config.axes.alpha2);
  EXPECT_EQ(a.config.axes.u, b.config.axes.u);
  EXPECT_EQ(a.config.axes.v, b.config.axes.v);
  EXPECT_EQ(a.config.axes.w0, b.config.axes.w0);
  EXPECT_EQ(a.config.workspace.home_rad, b.config.workspace.home_rad);
  EXPECT_EQ(a.config.workspace.q_home.coeffs(), b.config.workspace.q_home.coeffs());
  EXPECT_EQ(a.config.workspace.common_rad, b.config.workspace.common_rad);
  EXPECT_EQ(a.config.workspace.differential_rad, b.config.workspace.differential_rad);
  EXPECT_EQ(a.config.cells.per_axis, b.config.cells.per_axis);
  EXPECT_EQ(a.config.cells.width, b.config.cells.width);
  EXPECT_EQ(a.config.cells.overlap, b.config.cells.overlap);
  EXPECT_TRUE(same(a.config.rough, b.config.rough));
  ASSERT_EQ(b.config.fine.size(), 1U);
  EXPECT_TRUE(same(a.config.fine[0], b.config.fine[0]));
}

TEST(SphericalNetworkFile, SaysWhereItIsWrong) {
  const TemporaryFolder folder;
  const std::string text = spherical_network_text(any_network(), "# x\n");
  const auto error = [&](const std::string& from, const std::string& to) {
    const std::string file = folder.write("n.txtpb", replaced(text, from, to)).string();
    const std::string said = error_of([&] { load_spherical_network(file); });
    return said.starts_with(file) ? said.substr(file.size()) : said;
  };
  EXPECT_EQ(error("name:", "nmae:").substr(0, 5), ":2:1:");
  EXPECT_NE(error("per_axis: 1", "per_axis: 11").find("cells.per_axis = 11 is outside 1 to 9"),
            std::string::npos);
  EXPECT_EQ(error("per_axis: 1", "per_axis: 3"), ": fine occurs 1 times, but cells.per_axis = 3 requires 27");
  EXPECT_EQ(error("overlap: 0.25", ""), ": cells.overlap is missing");
  EXPECT_EQ(error("  offset:", "# "), ": rough.offset is missing");
  EXPECT_NE(error("common_rad: ", "common_rad: nan # ").find("is not a finite number"), std::string::npos);
  EXPECT_NE(error("in: [", "in: [1, ").find("rough.unit.0.in has 4 elements; 3 are needed"),
            std::string::npos);
  EXPECT_NE(error("  unit {", "  unit {}\n  unit {").find("rough.unit has 25 elements; 24 are needed"),
            std::string::npos);
}

}  // namespace
}  // namespace longreach::spherical_network_file_test
