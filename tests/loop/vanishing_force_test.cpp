// Whatever ends a contact force ends it by a ramp.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "tests/loop/pressing_hand.hpp"

namespace longreach::vanishing_force_test {
namespace {

struct Ending {
  const char* name;
  double scale;
  std::function<void(PressingHand&)> end;
};

const std::vector<Ending> kEndings = {
    {"clutch", 0.8, [](PressingHand& p) { p.clutch(true); }},
    {"rate mode", 0.8, [](PressingHand& p) { p.lab().requests().mode = MotionMode::kRate; }},
    {"hold", 0.8, [](PressingHand& p) { p.lab().requests().hold = true; }},
    {"engaged in a hold", 0.8,
     [](PressingHand& p) {
       p.lab().requests().hold = true;
       p.wait(1.0);
       EXPECT_GT(p.felt_n(), 1.0);
       p.lab().requests().engage = true;
     }},
    {"stop", 0.8, [](PressingHand& p) { p.lab().requests().stop = true; }},
    {"engaged during the ramp of a stop", 0.8,
     [](PressingHand& p) {
       p.lab().requests().stop = true;
       p.wait(0.02);
       p.lab().requests().engage = true;
     }},
    {"engaged after the ramp of a stop", 0.8,
     [](PressingHand& p) {
       p.lab().requests().stop = true;
       p.wait(0.07);
       p.lab().requests().engage = true;
     }},
    {"clutch released at once", 0.8,
     [](PressingHand& p) {
       p.clutch(true);
       p.wait(0.06);
       p.clutch(false);
     }},
    {"scale", 0.35, [](PressingHand& p) { p.lab().requests().scale = 1.0; }},
};

TEST(VanishingForce, FallsByARamp) {
  constexpr double kStep_n = 0.3 + 1e-3;
  for (const char* link : {"lab", "moon"}) {
    for (const Ending& ending : kEndings) {
      PressingHand p(link, ending.scale, 72);
      const double before_n = p.felt_n();
      EXPECT_GT(before_n, 1.5);
      p.step_n = p.beyond_n = 0.0;
      ending.end(p);
      p.wait(4.0);
      std::printf("%s, %s: felt %.2f N, steps of at most %.2f N, %.2f N beyond the motion\n", link,
                  ending.name, before_n, p.step_n, p.beyond_n);
      EXPECT_LE(p.beyond_n, kStep_n) << ending.name;
      EXPECT_GE(p.lab().master().port_energy_min_j, -0.021);
    }
  }
}

}  // namespace
}  // namespace longreach::vanishing_force_test
