#include "master/devices/delta/delta_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "deploy/lab/devices/delta_catalog.hpp"
#include "master/devices/delta/delta_kinematics.hpp"

namespace longreach::delta_geometry_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class Shape>
std::string refusal(const Shape& shape) {
  try {
    const DeltaGeometry geometry(shape);
  } catch (const GeometryError& e) {
    return e.what();
  }
  return "";
}

bool names(const std::string& refusal, const std::string& word) {
  return refusal.find(word) != std::string::npos;
}

const DeltaSimple kSimple{0.06, 0.11, 0.2, {0.0, 2.0, 4.0}};
const DeltaGeneral kFalcon{
    0.060, 0.1025, 0.01443, 0.01125, 0.01125, -0.025, 0.0400, -0.02309, {1.83, -0.26, -2.36}};

TEST(DeltaGeometry, RefusesALengthThatIsNone) {
  EXPECT_EQ(refusal(kSimple), "");
  for (const double bad : {-0.1, kNaN, kInf, -kInf}) {
    DeltaSimple s = kSimple;
    s.a = bad;
    EXPECT_TRUE(names(refusal(s), "a is")) << bad;
    s = kSimple, s.l1 = bad;
    EXPECT_TRUE(names(refusal(s), "l1 is")) << bad;
    s = kSimple, s.l2 = bad;
    EXPECT_TRUE(names(refusal(s), "l2 is")) << bad;
    s = kSimple, s.azimuth_rad[1] = kInf;
    EXPECT_TRUE(names(refusal(s), "azimuth is")) << bad;
  }
  DeltaSimple s = kSimple;
  s.l1 = 0.0;
  EXPECT_TRUE(names(refusal(s), "l1 is"));
}

TEST(DeltaGeometry, RefusesABadLengthOfTheGeneralLegByName) {
  EXPECT_EQ(refusal(kFalcon), "");
  const std::pair<const char*, double DeltaGeneral::*> lengths[] = {{"a is", &DeltaGeneral::a},
                                                                    {"b is", &DeltaGeneral::b},
                                                                    {"d is", &DeltaGeneral::d},
                                                                    {"e is", &DeltaGeneral::e}};
  for (const auto& [name, field] : lengths) {
    DeltaGeneral g = kFalcon;
    g.*field = -0.01;
    EXPECT_TRUE(names(refusal(g), name)) << name;
  }
  const std::pair<const char*, double DeltaGeneral::*> places[] = {{"c is", &DeltaGeneral::c},
                                                                   {"f is", &DeltaGeneral::f},
                                                                   {"r is", &DeltaGeneral::r},
                                                                   {"s is", &DeltaGeneral::s}};
  for (const auto& [name, field] : places) {
    DeltaGeneral g = kFalcon;
    g.*field = kNaN;
    EXPECT_TRUE(names(refusal(g), name)) << name;
  }
}

TEST(DeltaGeometry, RefusesTwoLegsAtOneAzimuth) {
  DeltaSimple s = kSimple;
  s.azimuth_rad = {0.3, 2.0, 0.3 + 2.0 * 3.141592653589793};
  EXPECT_TRUE(names(refusal(s), "legs 1 and 3 coincide")) << refusal(s);
  s.azimuth_rad = {0.0, 3.141592653589793, 1.0};  // opposite legs are two
  EXPECT_EQ(refusal(s), "");
}

TEST(DeltaGeometry, RefusesALoopThatNoPositionCloses) {
  DeltaSimple s = kSimple;
  s.a = 0.32;  // over l1 + l2
  EXPECT_TRUE(names(refusal(s), "impossible geometry"));
  s.a = 0.309;
  EXPECT_EQ(refusal(s), "");
  s.a = 1e300;
  EXPECT_NE(refusal(s), "");
}

TEST(DeltaGeometry, TakesAnySize) {
  for (const double size : {1e-9, 1e-3, 20.0, 1e9}) {
    const DeltaGeometry g(DeltaSimple{0.06 * size, 0.11 * size, 0.2 * size, {0.0, 2.0, 4.0}});
    const DeltaKinematics k(g);
    const Vector3 p = size * Vector3(0.01, 0.02, -0.17);
    const DeltaAngles angles = k.inverse(p);
    ASSERT_EQ(angles.status, SolutionStatus::kFound) << size;
    const DeltaPosition back = k.forward(angles.theta_rad, g.working_assembly(), Vector3::Zero());
    ASSERT_EQ(back.status, SolutionStatus::kFound) << size;
    EXPECT_LE((back.p_m - p).norm(), 1e-15 * size);
  }
}

TEST(DeltaGeometry, RefusesMassesByName) {
  EXPECT_NO_THROW(require_valid({0.1, 0.1, 0.5, 0.0}));
  EXPECT_THROW(require_valid({-0.1, 0.1, 0.5, 0.0}), GeometryError);
  EXPECT_THROW(require_valid({0.1, kNaN, 0.5, 0.0}), GeometryError);
  EXPECT_THROW(require_valid({0.1, 0.1, kNaN, 0.0}), GeometryError);
  EXPECT_THROW(require_valid({0.1, 0.1, 0.5, kInf}), GeometryError);
}

// Anything at all may come in; only finite numbers go out.
TEST(DeltaKinematics, AnswersAnyInputWithFiniteNumbers) {
  const double values[] = {0.0, -0.0, 1e-9, 1e-310, 0.1, -0.17, 1e9, 1e160, 1e300, kInf, -kInf, kNaN};
  for (const DeltaDesign& d : {omega_like(), novint_falcon()}) {
    const DeltaKinematics k(d.geometry);
    for (const double x : values) {
      for (const double y : values) {
        for (const double z : values) {
          const Vector3 v(x, y, z);
          EXPECT_TRUE(k.inverse(v, 5).theta_rad.allFinite());
          EXPECT_TRUE(k.inverse_all(v).second_rad.allFinite());
          EXPECT_TRUE(k.forward(v, DeltaAssembly::kNegative, d.home_m).p_m.allFinite());
          EXPECT_TRUE(k.forward(Vector3(0.4, 0.3, 0.5), DeltaAssembly::kNegative, v).p_m.allFinite());
          EXPECT_GE(k.forward_all(v).count, 0);
          if (!v.allFinite()) {
            EXPECT_EQ(k.inverse(v).status, SolutionStatus::kNoSolution);
            EXPECT_EQ(k.forward(v, DeltaAssembly::kNegative, d.home_m).status, SolutionStatus::kNoSolution);
            EXPECT_EQ(k.forward(v, DeltaAssembly::kNegative, d.home_m).p_m, d.home_m);
          }
        }
      }
    }
  }
}

// A leg at full stretch: both roots meet, and beyond there is none.
TEST(DeltaKinematics, ReachesToTheStretchedLegAndNoFarther) {
  const DeltaGeometry g(DeltaSimple{0.0, 0.1, 0.2, {0.0, 2.0, 4.0}});
  const DeltaKinematics k(g);
  const DeltaRoots stretched = k.inverse_all({0.0, 0.0, -0.3});
  EXPECT_EQ(stretched.status, SolutionStatus::kSingular);
  EXPECT_NEAR(stretched.first_rad[0], 1.5707963267948966, 1e-7);
  EXPECT_NEAR(stretched.second_rad[0], 1.5707963267948966, 1e-7);
  EXPECT_EQ(k.inverse({0.0, 0.0, -0.3000001}).status, SolutionStatus::kNoSolution);
  EXPECT_EQ(k.inverse({0.0, 0.0, -0.2999999}).status, SolutionStatus::kFound);
}

}  // namespace
}  // namespace longreach::delta_geometry_test
