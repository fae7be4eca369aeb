#include "deploy/lab/robot/mujoco_free_bodies.hpp"

#include <stdexcept>

#include "deploy/mujoco/bodies.hpp"
#include "deploy/mujoco/numbers.hpp"

namespace longreach {
MujocoFreeBodies::MujocoFreeBodies(MujocoWorld& world, const SceneConfig& scene, const Pose& X_WE_start)
    : world_(world), config_(*scene.bodies), X_WE_start_(X_WE_start) {
  const mjModel& m = world_.model();
  tool_ = numbered(mjOBJ_BODY, "tool");
  for (int b = 1; b < m.nbody; ++b) {
    const char* const name = mj_id2name(&m, mjOBJ_BODY, b);
    const bool free = m.body_jntnum[b] == 1 && m.jnt_type[m.body_jntadr[b]] == mjJNT_FREE;
    if (name == nullptr || !std::string(name).starts_with(scene_name("")) || !free) continue;
    const Pose X_BI = pose_at(m.body_ipos + 3 * b, m.body_iquat + 4 * b);
    number_.push_back(b);
    body_.push_back({std::string(name).substr(scene_name("").size()),
                     {m.body_mass[b], vector_at(m.body_inertia + 3 * b), vector_at(m.opt.gravity)},
                     pose_at(m.body_pos + 3 * b, m.body_quat + 4 * b) * X_BI,
                     X_BI});
    body_.back().X_start.p -= X_WE_start_.p;
  }
  state_.resize(body_.size());
  if (config_.gripper) {
    grasp_ = numbered(mjOBJ_EQUALITY, "grasp");
    fixture_ = numbered(mjOBJ_SITE, config_.gripper->fixture);
  }
  if (config_.latch) {
    striker_ = numbered(mjOBJ_GEOM, config_.latch->striker);
    keeper_ = numbered(mjOBJ_GEOM, config_.latch->keeper);
    for (int i = 0; i < m.npair; ++i)
      if (std::minmax(m.pair_geom1[i], m.pair_geom2[i]) == std::minmax(striker_, keeper_)) pair_ = i;
    if (pair_ < 0)
      throw std::invalid_argument(config_.mjcf_file + ": striker and keeper of the latch cannot touch");
  }
  feel();
}

int MujocoFreeBodies::numbered(mjtObj kind, const std::string& name) const {
  const int number = mj_name2id(&world_.model(), kind, scene_name(name).c_str());
  if (number < 0) throw std::invalid_argument(config_.mjcf_file + ": has no \"" + name + "\"");
  return number;
}

void MujocoFreeBodies::step(double dt) {
  if (!(dt > 0.0)) return;
  close_gripper();
  hold_by_latch(dt);
  world_.step(dt);
  feel();
  close_latch();
}

void MujocoFreeBodies::feel() {
  const mjModel& m = world_.model();
  const mjData& d = world_.data();
  for (std::size_t i = 0; i < number_.size(); ++i) {
    const int b = number_[i];
    RigidState& s = state_[i];
    s.X = pose_with_matrix(d.xipos + 3 * b, d.ximat + 9 * b);
    s.X.p -= X_WE_start_.p;
    mjtNum motion[6];  // rotation, translation; along W, of the centre of mass
    mj_objectVelocity(&m, &d, mjOBJ_BODY, b, motion, 0);
    s.v_m_per_s = vector_at(motion + 3);
    s.spin_kg_m2_per_s =
        s.X.q * body_[i].mass.inertia_kg_m2.cwiseProduct(s.X.q.conjugate() * vector_at(motion));
  }
  contact_.F_E_W = world_.external_wrench();
  contact_.contacts = 0;
  contact_.depth_m = 0.0;
  for (int i = 0; i < d.ncon; ++i) {
    if (!(d.contact[i].dist < 0.0)) continue;
    ++contact_.contacts;
    contact_.depth_m = std::max(contact_.depth_m, -d.contact[i].dist);
  }
  contact_.holds = grasp_ >= 0 && m.eq_active[grasp_] != 0;
}

void MujocoFreeBodies::close_gripper() {
  if (grasp_ < 0 || closed_ == contact_.holds) return;
  mjModel& m = world_.changeable_model();
  const mjData& d = world_.data();
  if (!closed_) {
    m.eq_active[grasp_] = 0;
    return;
  }
  const Pose tool = pose_at(d.xpos + 3 * tool_, d.xquat + 4 * tool_),
             fixture = pose_with_matrix(d.site_xpos + 3 * fixture_, d.site_xmat + 9 * fixture_);
  if ((fixture.p - tool.p).norm() > config_.gripper->reach_m ||
      log_rotation(fixture.q * tool.q.conjugate()).norm() > config_.gripper->reach_rad)
    return;
  const int held = m.eq_obj2id[grasp_];
  const Pose between =
      inverse(pose_at(d.xpos + 3 * held, d.xquat + 4 * held)) * tool;  // of the tool in the body
  mjtNum* const data = m.eq_data + mjNEQDATA * grasp_;
  put(between.p, data);            // the point in the second body
  put(Vector3::Zero(), data + 3);  // and in the first one
  put(between.q.conjugate(), data + 6);
  m.eq_active[grasp_] = 1;
}

void MujocoFreeBodies::close_latch() {
  if (pair_ < 0 || contact_.latched) return;
  mjModel& m = world_.changeable_model();
  const mjData& d = world_.data();
  double depth_m = 0.0;
  for (int i = 0; i < d.ncon; ++i)
    if (std::minmax(d.contact[i].geom1, d.contact[i].geom2) == std::minmax(striker_, keeper_))
      depth_m = std::max(depth_m, -d.contact[i].dist);
  if (depth_m < config_.latch->travel_m) return;
  const int body = m.geom_bodyid[striker_], base = m.geom_bodyid[keeper_];
  const Pose X = pose_at(d.xpos + 3 * body, d.xquat + 4 * body);
  const Quaternion turned = X.q * quaternion_at(m.body_quat + 4 * body).conjugate();
  const Pose keeper = pose_with_matrix(d.geom_xpos + 3 * keeper_, d.geom_xmat + 9 * keeper_);
  if (log_rotation(keeper.q.conjugate() * turned).norm() > config_.latch->angle_rad) return;
  constexpr double kNever_m = -1e3;
  m.pair_margin[pair_] = kNever_m;
  striker_was_ = X;
  rest_ = rest(pose_at(d.xpos + 3 * base, d.xquat + 4 * base), X, vector_at(d.xipos + 3 * body));
  contact_.latched = true;
}

// The keeper is at rest in the world: MujocoBodies gives all that is no free body to one body.
void MujocoFreeBodies::hold_by_latch(double dt) {
  if (!contact_.latched) return;
  const mjModel& m = world_.model();
  mjData& d = world_.changeable_data();
  const int body = m.geom_bodyid[striker_], base = m.geom_bodyid[keeper_];
  const Pose at = pose_at(d.xpos + 3 * base, d.xquat + 4 * base),
             X = pose_at(d.xpos + 3 * body, d.xquat + 4 * body);
  const Interaction held =
      hold(config_.latch->bond, rest_, {at, at, {}}, {striker_was_, X, move_between(striker_was_, X)}, dt);
  striker_was_ = X;
  const Vector3 moment = held.moment_nm + (held.point_m - vector_at(d.xipos + 3 * body)).cross(held.force_n);
  put(held.force_n, d.xfrc_applied + 6 * body);
  put(moment, d.xfrc_applied + 6 * body + 3);
}

void MujocoFreeBodies::push(int i, const Vector3& v_m_per_s, const Vector3& w_rad_per_s) {
  const mjModel& m = world_.model();
  mjData& d = world_.changeable_data();
  const int b = number_[static_cast<std::size_t>(i)];
  mjtNum* const v = d.qvel + m.body_dofadr[b];
  // Of the origin of the body in W, and along its own axes.
  put(Vector3(v_m_per_s + w_rad_per_s.cross(vector_at(d.xpos + 3 * b) - vector_at(d.xipos + 3 * b))), v);
  put(Vector3(quaternion_at(d.xquat + 4 * b).conjugate() * w_rad_per_s), v + 3);
  mj_forward(&m, &d);
  feel();
}

void MujocoFreeBodies::place(int i, const Pose& X_S) {
  const mjModel& m = world_.model();
  mjData& d = world_.changeable_data();
  const Pose X_WB = Pose{X_WE_start_.p, Quaternion::Identity()} * X_S * inverse(body(i).X_BI);
  mjtNum* const q = d.qpos + m.jnt_qposadr[m.body_jntadr[number_[static_cast<std::size_t>(i)]]];
  put(X_WB.p, q);
  put(X_WB.q.normalized(), q + 3);
  mj_forward(&m, &d);
  feel();
}

Vector3 MujocoFreeBodies::to_fixture_m() const {
  if (fixture_ < 0) return Vector3::Zero();
  return vector_at(world_.data().site_xpos + 3 * fixture_) - vector_at(world_.data().xpos + 3 * tool_);
}

Pose MujocoFreeBodies::pose(int i) const {
  const mjData& d = world_.data();
  const int b = number_[static_cast<std::size_t>(i)];
  return pose_at(d.xpos + 3 * b, d.xquat + 4 * b);
}

}  // namespace longreach
