#pragma once
// Free-floating rigid bodies and their contacts, a gripper that holds one of them, and a latch. The motion of
// the tool is given. Bodies move only by contact (Hunt-Crossley), by the bonds of gripper and latch, and by
// gravity. Each step solves one implicit equation for the mean wrenches (interaction.hpp) by Newton
// iteration. For any stiffness and for several simultaneous contacts, momentum is conserved, no contact
// pulls, and
//   energy of the bodies, contacts and bonds  <=  previous energy + work of the tool
// Frame S has its origin at the start position of the tool and the axes of W; the body `tool` starts aligned
// with S. There is no friction. Bodies do not deflect a robot with flexible joints.

#include <array>
#include <cstdint>
#include <optional>

#include "slave/simulation/scene/free_bodies.hpp"
#include "slave/simulation/scene/interaction.hpp"

namespace longreach {

class Bodies final : public FreeBodies {
 public:
  /// `scene.bodies` must be set. Throws std::invalid_argument like CollisionModel.
  Bodies(const SceneConfig& scene, const Pose& X_WE_start);

  /// Closes or opens the gripper. A closing gripper grasps the fixture if it is within reach; an opening
  /// gripper releases it.
  void grip(bool closed) { closed_ = closed; }

  /// Moves the tool to `X_WE` within `dt` s. `dt` = 0 changes nothing.
  const BodiesContact& step(const Pose& X_WE, double dt);

  [[nodiscard]] const BodiesContact& contact() const override { return contact_; }
  [[nodiscard]] int count() const override { return model_.tool(); }
  [[nodiscard]] const FreeBody& body(int i) const override {
    return model_.bodies()[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const RigidState& state(int i) const override { return state_[static_cast<std::size_t>(i)]; }
  /// Pose of the body's frame in the file, in W.
  [[nodiscard]] Pose pose(int i) const;
  void push(int i, const Vector3& v_m_per_s, const Vector3& w_rad_per_s) override;
  void place(int i, const Pose& X_S) override;
  [[nodiscard]] Vector3 to_fixture_m() const override;

  [[nodiscard]] std::optional<BodiesEnergy> energy() const override {
    return BodiesEnergy{energy_j(), tool_work_j_, spent_j_};
  }
  /// Kinetic and gravitational energy of the bodies plus the energy in contacts and bonds.
  [[nodiscard]] double energy_j() const;
  [[nodiscard]] double tool_work_j() const { return tool_work_j_; }  // work done by the tool so far
  [[nodiscard]] double spent_j() const { return spent_j_; }  // energy released by gripper and latch so far
  [[nodiscard]] std::uint64_t unconverged() const override { return unconverged_; }

 private:
  static constexpr int kMost = CollisionModel::kBodiesMax;
  static constexpr int kRows = 6 * kMost;
  using Wrenches = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kRows, 1>;
  using Stiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kRows, kRows>;

  struct Attempt {
    std::array<RigidState, kMost> to{};
    std::array<Mover, kMost + 2> mover{};
    Wrenches answer{};
    Wrench on_tool{};  // wrench about the middle of the tool's path
    double tool_work_j = 0.0;
    Stiffness stiffness{};
  };
  struct Held {
    int body;
    BondRest rest;
  };

  void advance(const Pose& X_tool, double dt, int splits);
  void attempt(const Wrenches& w, const Pose& X_tool, double dt, Attempt& out);
  void answer(double dt, Attempt& out);
  void find_contacts(double dt, Attempt& out);
  /// Returns an upper bound on the distance by which any two geoms approach each other in the step.
  [[nodiscard]] double nearer_m(const Attempt& a) const;
  void add(const Interaction& f, int a, int b, Attempt& out) const;
  void accept(const Attempt& done, const Pose& X_tool, double dt);
  void find_near_pairs();  // finds the pairs that are near each other in the current state
  void close_gripper();
  void close_latch();
  [[nodiscard]] bool off(const GeomPair& pair) const;
  [[nodiscard]] Pose fixture() const;

  CollisionModel model_;
  std::optional<GripperConfig> gripper_;
  std::optional<LatchConfig> latch_;
  CollisionModel::Site fixture_{};
  int striker_ = -1, keeper_ = -1;
  Pose X_WE_start_;
  std::array<RigidState, kMost> state_{};
  Pose X_tool_{};               // pose of the tool in S
  std::vector<GeomPair> near_;  // pairs near each other in the current state
  double clear_m_ = 0.0;        // lower bound on the distance between any two geoms
  bool closed_ = false;
  std::optional<Held> held_{}, latched_{};
  Wrench impulse_{};  // impulse on the tool in this step
  BodiesContact contact_{};
  double tool_work_j_ = 0.0;
  double spent_j_ = 0.0;
  std::uint64_t unconverged_ = 0;
  Wrenches last_{};  // mean wrenches of the last step
  Attempt best_{}, next_{};
};

}  // namespace longreach
