// The truth of a MuJoCo world, which the laboratory compares with what is felt.

#include <algorithm>
#include <limits>

#include "deploy/mujoco/numbers.hpp"
#include "deploy/mujoco/world.hpp"

namespace longreach {
std::vector<MujocoContact> MujocoWorld::contacts() const {
  const mjModel* m = model_.get();
  const mjData* d = data_.get();
  const Vector3 p_WE = vector_at(d->site_xpos + 3 * site_);
  std::vector<MujocoContact> out;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    const bool first = of_tool(contact.geom1);
    if (first == of_tool(contact.geom2) || contact.efc_address < 0) continue;
    const int geom = first ? contact.geom2 : contact.geom1;
    mjtNum force[6];  // along the axes of the contact, whose first one points from geom1 to geom2
    mj_contactForce(m, d, i, force);
    const double sign = first ? -1.0 : 1.0;  // on the second geom
    Wrench w;
    for (int k = 0; k < 3; ++k) {
      w.force += sign * force[k] * vector_at(contact.frame + 3 * k);
      w.moment += sign * force[3 + k] * vector_at(contact.frame + 3 * k);
    }
    const Vector3 point_m = vector_at(contact.pos);
    w.moment += (point_m - p_WE).cross(w.force);
    auto of_geom = std::ranges::find(out, geom, &MujocoContact::geom);
    if (of_geom == out.end()) of_geom = out.insert(out.end(), {.geom = geom});
    of_geom->F_E_W.force += w.force;
    of_geom->F_E_W.moment += w.moment;
    of_geom->normal += sign * force[0] * vector_at(contact.frame);
    of_geom->point_m += force[0] * point_m;
    of_geom->normal_n += force[0];
    of_geom->depth_m = std::max(of_geom->depth_m, -contact.dist);
  }
  std::erase_if(out, [](const MujocoContact& c) { return !(c.normal_n > 0.0) || !(c.normal.norm() > 0.0); });
  for (MujocoContact& c : out) {
    c.point_m /= c.normal_n;
    c.normal.normalize();
  }
  return out;
}

Wrench MujocoWorld::external_wrench() const {
  const mjModel* m = model_.get();
  const mjData* d = data_.get();
  const Vector3 p_WE = vector_at(d->site_xpos + 3 * site_);
  Wrench sum;
  for (int b = m->site_bodyid[site_]; b < m->nbody; ++b) {
    int carrier = b;
    while (carrier > m->site_bodyid[site_]) carrier = m->body_parentid[carrier];
    if (carrier != m->site_bodyid[site_]) continue;
    // About the centre of mass of the tree.
    const mjtNum* const w = d->cfrc_ext + 6 * b;
    const Vector3 arm = vector_at(d->subtree_com + 3 * m->body_rootid[b]) - p_WE, force = vector_at(w + 3);
    sum.moment += vector_at(w) + arm.cross(force);
    sum.force += force;
  }
  return sum;
}

std::string MujocoWorld::geom_name(int geom) const {
  const char* name = mj_id2name(model_.get(), mjOBJ_GEOM, geom);
  if (name == nullptr) name = mj_id2name(model_.get(), mjOBJ_BODY, model_->geom_bodyid[geom]);
  return name != nullptr ? name : "geom " + std::to_string(geom);
}

double MujocoWorld::spring_compliance(const MujocoContact& contact) const {
  const mjModel* m = model_.get();
  std::vector<mjtNum> jacobian(3 * static_cast<std::size_t>(m->nv));
  mj_jac(m, data_.get(), jacobian.data(), nullptr, contact.point_m.data(), m->geom_bodyid[contact.geom]);
  double compliance = 0.0;
  for (int dof = 0; dof < m->nv; ++dof) {
    double along = 0.0;
    for (int k = 0; k < 3; ++k)
      along += contact.normal[k] * jacobian[static_cast<std::size_t>(k * m->nv + dof)];
    constexpr double kAcross = 1e-9;  // m/rad or 1: the joint does not move the point along the normal
    if (std::abs(along) <= kAcross) continue;
    const double stiffness = m->jnt_stiffness[m->dof_jntid[dof]];
    if (!(stiffness > 0.0)) return std::numeric_limits<double>::infinity();
    compliance += along * along / stiffness;
  }
  return compliance;
}

std::uint64_t MujocoWorld::fingerprint() const {
  std::vector<unsigned char> bytes(static_cast<std::size_t>(mj_sizeModel(model_.get())));
  mj_saveModel(model_.get(), nullptr, bytes.data(), static_cast<int>(bytes.size()));
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3U;
  return hash;
}

}  // namespace longreach
