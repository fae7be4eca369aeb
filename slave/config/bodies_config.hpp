#pragma once
// Free-floating bodies of a scene. proto/config.proto documents the meaning, unit and range of these fields
// under the same names.

#include <optional>
#include <string>
#include <vector>

namespace longreach {

struct SceneFileConfig {
  std::string name;
  std::string text;
};

struct BondConfig {
  double stiffness_n_per_m = 2e4;
  double damping_n_s_per_m = 1500.0;
  double stiffness_nm_per_rad = 500.0;
  double damping_nm_s_per_rad = 50.0;
  double play_m = 0.0;
  double play_rad = 0.0;
};

struct GripperConfig {
  std::string fixture = "fixture";
  double reach_m = 0.02;
  double reach_rad = 0.15;
  BondConfig bond{};
};

struct LatchConfig {
  std::string striker = "striker";
  std::string keeper = "keeper";
  double travel_m = 0.004;
  double angle_rad = 0.1;
  BondConfig bond{};
};

struct BodiesConfig {
  std::string mjcf_file;
  std::vector<SceneFileConfig> file;  // the MJCF file first, then the files that it includes or refers to
  std::optional<GripperConfig> gripper{};
  std::optional<LatchConfig> latch{};
};

}  // namespace longreach
