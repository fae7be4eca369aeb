#include "tests/faults/scenario.hpp"

#include <array>
#include <filesystem>
#include <mutex>

#include "common/config/config.hpp"
#include "common/core/random.hpp"
#include "common/text/number_text.hpp"
#include "deploy/lab/experiment.hpp"
#include "slave/kinematics/kinematics.hpp"
#include "tests/faults/kind.hpp"

namespace longreach {
namespace {

constexpr int kDraws = 8;  // of limits that agree with each other

template <std::size_t N>
std::string one_of(Random& random, const std::array<const char*, N>& names) {
  return names[random.next() % N];
}

std::string number(Random& random, double low, double high) {
  return format_number(log_scale(random.uniform(), low, high));
}

std::vector<std::string> places(Random& random) {
  const bool cartesian = random.chance(0.15);
  const std::string robot =
      cartesian ? "cartesian"
                : one_of<10>(random, {"space_arm", "space_arm", "space_arm", "ur10", "puma560", "puma560",
                                      "ur5e", "kr6", "irb120", "gantry"});
  const std::string scene = one_of<6>(random, {"wall", "wall", "wall", "free", "layers", "hinge"});
  return {"robot_file=robots/" + robot + (robot == "gantry" ? ".urdf" : ".txtpb"),
          "scene_file=scenes/" + (cartesian && scene == "hinge" ? "wall" : scene) + ".txtpb",
          "device_file=devices/" + one_of<4>(random, {"desktop", "desktop", "falcon", "paper"}) + ".txtpb",
          "profile=" +
              one_of<8>(random, {"lab", "lab", "lab", "kontur", "gateway", "georelay", "analog", "moon"})};
}

std::vector<std::string> habits(Random& random) {
  std::vector<std::string> all = {
      "safety.engage_at_start=false",
      "mapping.scale=" + format_number(0.05 * static_cast<double>(2 + random.next() % 19)),
      std::string("mapping.mode=") + (random.chance(0.25) ? "RATE" : "POSITION"),
      std::string("hand.grip=") + (random.chance(0.3) ? "FIRM" : "LIGHT"),
      std::string("safety.presence=") + (random.chance(0.5) ? "HOLD" : "IGNORE")};
  if (random.chance(0.3)) all.push_back("link.send_hz=" + number(random, 100.0, 1000.0));
  if (random.chance(0.2)) all.push_back("playout.adaptive=false");
  return all;
}

std::vector<std::string> limits(Random& random, const std::string& scene) {
  std::vector<std::string> all = {"command.force_guard_n=" + number(random, 10.0, 40.0),
                                  "command.speed_max_m_per_s=" + number(random, 0.05, 0.25),
                                  "command.workspace_m=" + number(random, 0.3, 3.0)};
  if (scene.find("hinge") != std::string::npos) {
    all.push_back("command.moment_guard_nm=" + number(random, 0.5, 5.0));
    all.push_back("scene.material.stop.stiffness_n_per_m=" + number(random, 500.0, 3e4));
  }
  if (scene.find("wall") == std::string::npos) return all;
  all.push_back("scene.surface.wall.plane.point_m=" + number(random, 0.01, 0.06) + ",0,0");
  all.push_back("scene.material.wall.stiffness_n_per_m=" + number(random, 200.0, 1e4));
  if (random.chance(0.3)) all.push_back("scene.material.wall.exponent=1.5");
  return all;
}

/// A limit of a joint that is near its start.
std::vector<std::string> near_boundary(Random& random, const RobotConfig& robot) {
  const std::size_t number = random.next() % robot.joint.size();
  const bool upper = random.chance(0.5);
  const JointConfig& joint = robot.joint[number];
  const bool slides = joint.kind == JointKind::kPrismatic;
  const double room = random.uniform(0.01, slides ? 0.05 : 0.15);
  if (joint.kind == JointKind::kFixed) return {};
  const double limit = upper ? std::min(joint.max_rad, joint.start_rad + room)
                             : std::max(joint.min_rad, joint.start_rad - room);
  return {"robot.joint." + std::to_string(number) + (upper ? ".max_rad=" : ".min_rad=") +
          format_number(limit)};
}

void read(Scenario& scenario, const std::filesystem::path& deploy) {
  scenario.config = configure(scenario.settings, deploy);
  scenario.master = to_struct(scenario.config.master());
  scenario.slave = to_struct(scenario.config.slave());
}

}  // namespace

Scenario draw_scenario(std::uint64_t seed) {
  const Random root(seed);
  Random where = root.child("place"), who = root.child("habits"), how = root.child("limits");
  Scenario scenario;
  scenario.settings = places(where);
  for (std::string& habit : habits(who)) scenario.settings.push_back(std::move(habit));
  Random direction = root.child("way");
  scenario.settings.push_back("command.give_way_m=" + number(direction, 0.03, 0.2));
  const std::size_t kept = scenario.settings.size();
  const std::filesystem::path deploy = find_deploy_folder();
  for (int draw = 0; draw <= kDraws; ++draw) {
    scenario.settings.resize(kept);
    if (draw < kDraws) {
      for (std::string& limit : limits(how, scenario.settings[1]))
        scenario.settings.push_back(std::move(limit));
    }
    try {
      read(scenario, deploy);
      break;
    } catch (const ConfigError&) {
      // Limits that a guard could not hold are refused: others are drawn, at last those of the files.
      if (draw == kDraws) throw;
    }
  }
  Random limit = root.child("boundary");
  const bool urdf = scenario.settings[0].ends_with(".urdf");  // its limits stand in the URDF
  if (!urdf && limit.chance(0.2)) {
    for (std::string& near : near_boundary(limit, scenario.slave.robot))
      scenario.settings.push_back(std::move(near));
    read(scenario, deploy);
  }
  scenario.empty_scene = root.child("scene").chance(0.2);
  const ImpairmentConfig &down = scenario.master.link.impairment, &up = scenario.slave.link.impairment;
  scenario.round_trip_s = down.delay_s + up.delay_s + 2.0 * (down.jitter_s + up.jitter_s);
  scenario.metamorphic = down.jitter_s + up.jitter_s + down.loss + up.loss + down.reorder + up.reorder == 0.0;
  return scenario;
}

Pose start_pose(const Scenario& scenario) {
  JointVector start;
  for (int i = 0; i < kMaxJoints; ++i)
    start[i] = scenario.slave.robot.joint[static_cast<std::size_t>(i)].start_rad;
  return Kinematics(scenario.slave.robot).forward(start);
}

}  // namespace longreach
