#include "master/rendering/renderer.hpp"

#include <gtest/gtest.h>

namespace longreach {
namespace {

TEST(Renderer, ResistsAHandAndNotAHandleThatIsLetGo) {
  Renderer renderer(RenderingConfig{}, RenderedDevice{});
  Mapping mapping{MappingConfig{}};
  RendererInput in;
  in.mode = MotionMode::kRate;
  in.live = true;
  const auto step = [&] {
    mapping.step({in.handle, in.mode, in.scale, false}, 1e-3);
    return renderer.step(in, mapping);
  };
  mapping.reset(in.handle);
  renderer.reset(in.handle);
  for (int i = 1; i <= 300; ++i) {
    in.handle.p_MH = {1e-4 * i, 0.0, 0.0};
    in.handle.velocity_m_per_s = {0.1, 0.0, 0.0};
    step();
  }
  EXPECT_LT(step().force.x(), -60.0 * 0.03);  // the spring of rate mode, and damping
  in.handle.velocity_m_per_s.setZero();
  in.handle.held = false;
  EXPECT_EQ(step().force, Vector3::Zero());
  EXPECT_EQ(step().moment, Vector3::Zero());
}

}  // namespace
}  // namespace longreach
