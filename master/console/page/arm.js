// The arm as last reported by the slave, and the ghost, a copy of its tool at the operator's current goal.

import { CylinderBufferGeometry, Group, Matrix4, Mesh, MeshStandardMaterial, Quaternion, SphereBufferGeometry,
  TorusBufferGeometry, Vector3 } from 'three';

import { at_limit, frames } from './kinematics.js';

const UP = new Vector3(0, 1, 0);
const QUILL_M = 0.12;
const TIP_M = 0.3;     // part of the last link that the ghost shows

/** A tapered cylinder along y that starts at the origin. */
function cone(length, from, to, material) {
  const geometry = new CylinderBufferGeometry(to, from, length, 24, 1);
  geometry.translate(0, length / 2, 0);
  return new Mesh(geometry, material);
}

function place_between(mesh, a, b) {
  const along = b.clone().sub(a);
  mesh.position.copy(a);
  mesh.quaternion.setFromUnitVectors(UP, along.normalize());
}

const origin = (frame) => new Vector3().setFromMatrixPosition(frame);

export class Arm {
  constructor(robot, tip_radius_m, colors) {
    this.robot = robot;
    this.group = new Group();
    this.metal = new MeshStandardMaterial({ color: colors.link, roughness: 0.55, metalness: 0.15 });
    this.joint = new MeshStandardMaterial({ color: colors.robot, roughness: 0.5, metalness: 0 });
    this.limit = new MeshStandardMaterial({ color: colors.contact, roughness: 0.5, metalness: 0 });
    this.ghostly = new MeshStandardMaterial({ color: colors.operator, roughness: 0.6, metalness: 0, transparent: true,
      opacity: 0.45, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 });
    const start = frames(robot, robot.joint.map((joint) => joint.start_rad));
    const places = start.map(origin);
    const reach = places.slice(1).reduce((sum, p, i) => sum + p.distanceTo(places[i]), 0);
    // Three prismatic joints that start at zero have no length. A quill from above represents them.
    this.quill = reach < 0.05;
    this.radius = Math.max(0.011 * reach, 0.006);
    this.tip_radius_m = tip_radius_m;
    this.links = [];
    this.joints = [];
    for (let i = 1; i < start.length; ++i) this.add_row(i, places);
    const at_tool = start.at(-1);
    this.group.add(this.tip = this.make_tip(this.metal, start));
    this.ghost = this.make_tip(this.ghostly, start);
    this.ghost.visible = false;
    this.tip_from_tool = new Matrix4();
    this.set(robot.joint.map((joint) => joint.start_rad));
    this.start = at_tool;
  }

  add_row(i, places) {
    const length = places[i].distanceTo(places[i - 1]);
    const radius = this.robot.joint[i - 1]?.draw_radius_m || this.radius;
    if (!this.quill && this.robot.joint[i - 1] && this.robot.joint[i - 1].kind !== 'FIXED') {
      const collar = new Mesh(new CylinderBufferGeometry(1.35 * radius, 1.35 * radius, 2.2 * radius, 28), this.joint);
      collar.geometry.rotateX(Math.PI / 2);     // along the joint's own axis, z
      this.group.add(collar);
      this.joints.push({ mesh: collar, row: i - 1 });
    }
    const last = i === places.length - 1 || this.rest_is_short(i, places);
    if (length < 1e-6 || this.quill) return;
    const link = cone(1, radius, last ? this.tip_base() : radius, this.metal);
    this.group.add(link);
    this.links.push({ mesh: link, row: i, last });
  }

  /** Returns true if only the tip of the tool follows this row. */
  rest_is_short(i, places) {
    return places.slice(i).every((p) => p.distanceTo(places.at(-1)) < 1e-6);
  }

  tip_length() { return this.quill ? QUILL_M : Math.min(TIP_M, 2.5 * this.radius); }

  tip_base() { return Math.min(0.2 * this.radius, 0.022); }

  /** A slender tip along the direction of the last link, which ends in the origin. */
  make_tip(material) {
    const tip = new Group();
    const length = this.tip_length();
    const body = cone(length, this.tip_base(), Math.max(0.5 * this.tip_radius_m, 0.004), material);
    body.position.y = -length;
    tip.add(body, new Mesh(new SphereBufferGeometry(Math.max(this.tip_radius_m, 0.005), 24, 16), material));
    return tip;
  }

  /** Sets the measured joint positions. */
  set(q) {
    const now = frames(this.robot, q);
    const places = now.map(origin);
    for (const { mesh, row, last } of this.links) {
      // The last link is shorter by the length of its tip.
      const length = places[row].distanceTo(places[row - 1]) - (last ? this.tip_length() : 0);
      mesh.visible = length > 1e-6;
      if (!mesh.visible) continue;
      place_between(mesh, places[row - 1], places[row]);
      mesh.scale.y = length;
    }
    const limits = at_limit(this.robot, q);
    for (const { mesh, row } of this.joints) {
      mesh.position.copy(places[row]);
      mesh.quaternion.setFromRotationMatrix(now[row]);
      mesh.material = limits.includes(row) ? this.limit : this.joint;
    }
    const tool = now.at(-1);
    this.tool_m = origin(tool);
    this.tool_q = new Quaternion().setFromRotationMatrix(tool);
    const before = places.findLast((p) => p.distanceTo(this.tool_m) > 1e-6) ?? this.tool_m.clone().sub(UP);
    this.approach = this.quill ? new Vector3(0, 0, -1) : this.tool_m.clone().sub(before).normalize();
    this.along = this.approach.clone().applyQuaternion(this.tool_q.clone().conjugate());   // in the tool's frame
    this.tip.position.copy(this.tool_m);
    this.tip.quaternion.setFromUnitVectors(UP, this.approach);
  }

  /** Sets the goal of the tool; null hides the ghost. */
  set_ghost(pose) {
    this.ghost.visible = Boolean(pose);
    if (!pose) return;
    this.ghost.position.copy(pose.position);
    this.ghost.quaternion.setFromUnitVectors(UP, this.along.clone().applyQuaternion(pose.quaternion));
  }
}

/** A ring perpendicular to the approach direction of the tool: the last reported goal of the robot. */
export function ring(radius, color) {
  return new Mesh(new TorusBufferGeometry(radius, 0.06 * radius, 10, 40),
    new MeshStandardMaterial({ color, roughness: 1, metalness: 0 }));
}
