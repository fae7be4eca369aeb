#pragma once
// A window in which a person sees the world of longreach-mujoco: geoms, contact forces, the tool. It draws in a thread of its
// own, so that the simulation never waits for it.

#include <memory>

#include "deploy/mujoco/world.hpp"

namespace longreach {

class MujocoWindow {
 public:
  /// Opens the window. `world` must outlive it. Throws std::runtime_error if there is no display.
  explicit MujocoWindow(const MujocoWorld& world);
  ~MujocoWindow();
  MujocoWindow(const MujocoWindow&) = delete;
  MujocoWindow& operator=(const MujocoWindow&) = delete;

  /// Hands the present state over if the last one has been drawn. Never waits. Call it in the thread that moves the world.
  void show();
  /// Whether the person has asked for the start since the last call.
  [[nodiscard]] bool takes_reset();
  /// Whether the person has closed the window.
  [[nodiscard]] bool closed() const;

 private:
  class Drawing;
  const MujocoWorld& world_;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace longreach
