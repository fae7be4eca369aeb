#pragma once
// A station whose tool is watched while the hand at the master changes: without input, neither the tool moves nor the
// force rises.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/spatial/spatial.hpp"
#include "tests/support/station.hpp"

namespace longreach {

class QuietStation : public Station {
 protected:
  static constexpr double kMoved_m = 1e-3, kMore_n = 0.5;

  /// Settings of the slave: free space, or a wall 30 mm in front of the tool along +x.
  static std::vector<std::string> place(bool contact) {
    return {"--set", contact ? "scene.surface.wall.plane.point_m=0.03,0,0" : "scene_file=scenes/free.txtpb"};
  }
  Vector3 tool_m() {
    const auto s = slave_.status();
    return s && s->tool_m_size() == 3 ? Vector3(s->tool_m(0), s->tool_m(1), s->tool_m(2))
                                      : Vector3(NAN, NAN, NAN);
  }
  double tool_x() { return tool_m().x(); }
  double force_n() {
    const auto s = slave_.status();
    return s ? s->force_n() : NAN;
  }
  /// Mean of the measured force, which has noise.
  double mean_force_n() {
    constexpr int kSamples = 20;
    double sum_n = 0.0;
    for (int i = 0; i < kSamples; ++i) sum_n += force_n();
    return sum_n / kSamples;
  }
  /// Waits until the tool has moved by less than 0.05 mm in 0.2 s.
  bool rests() {
    Vector3 last_m = tool_m();
    return eventually([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      const Vector3 now_m = tool_m();
      return (now_m - std::exchange(last_m, now_m)).norm() < 5e-5;
    });
  }
  /// Performs a change that ends when `changed` returns true; the second that follows is watched.
  void expect_quiet(const std::string& what, const std::function<void()>& act,
                    const std::function<bool()>& changed) {
    SCOPED_TRACE(what);
    ASSERT_TRUE(rests()) << outputs();
    const Vector3 from_m = tool_m();
    const double before_n = mean_force_n();
    double moved_m = 0.0, largest_n = 0.0;
    const auto watch = [&] {
      moved_m = std::max(moved_m, (tool_m() - from_m).norm());
      largest_n = std::max(largest_n, force_n());
    };
    act();
    ASSERT_TRUE(eventually([&] {
      watch();
      return changed();
    })) << outputs();
    using Clock = std::chrono::steady_clock;
    for (const auto end = Clock::now() + std::chrono::seconds(1); Clock::now() < end;) watch();
    EXPECT_LE(moved_m, kMoved_m) << outputs();
    EXPECT_LE(largest_n, before_n + kMore_n);
    worst_m_ = std::max(worst_m_, moved_m);
    worst_n_ = std::max(worst_n_, largest_n - before_n);
  }
  void expect_quiet_engaged(const std::string& what, const std::function<void()>& act) {
    expect_quiet(what, act, [this] { return engaged_now(); });
  }
  /// Waits until input has moved the tool towards +x by at least `least_m`.
  void expect_moves(const std::function<void()>& input, double least_m) {
    const double x_m = tool_x();
    EXPECT_TRUE(eventually(
        [&] {
          input();
          return tool_x() - x_m > least_m;
        },
        std::chrono::seconds(10)))
        << outputs();
    EXPECT_TRUE(rests());
  }
  /// Presses on the wall by about 3 N: less than the hold limit, which no hold reduces.
  void press(const std::function<void()>& deeper) {
    for (int i = 0; i < 50 && !(mean_force_n() > 2.5); ++i) {
      deeper();
      ASSERT_TRUE(rests());
    }
    ASSERT_GT(mean_force_n(), 2.2) << outputs();  // with the noise of the sensor
  }
  bool engaged_now() { return master_.state() == "Engaged" && slave_.state() == "Engaged"; }
  bool held_now() { return slave_.state() == "Holding"; }
  bool stopped_now() { return slave_.state() == "Stopped"; }
  void print_worst(const std::string& what) const {
    std::printf("changes of hands, %s: at most %.2f mm, %.2f N more\n", what.c_str(), 1e3 * worst_m_,
                worst_n_);
  }

  double worst_m_ = 0.0, worst_n_ = 0.0;
};

}  // namespace longreach
