// The bodies in the MJCF of a scene: boxes, spheres, capsules and cylinders with their poses; meshes are omitted. A free
// body is drawn at the newest pose that the slave reported; its number is its place among the free bodies of the file. It
// is translucent if this pose is out of date, or if there is none. A body that is reported but is not in the file, as those
// that a real robot tracks, is drawn as a marker (body_marker.js). A robot that tracks no bodies reports none: a body is
// then drawn at its start pose or where it was released, and moves with the tool while the gripper holds it. The goal of a
// body is drawn as its wires.

import { BoxBufferGeometry, CylinderBufferGeometry, Euler, Group, LatheBufferGeometry, Mesh, MeshStandardMaterial, Path,
  MeshBasicMaterial, Quaternion, SphereBufferGeometry, Vector3 } from 'three';

import { BodyMarker } from './body_marker.js';
import { orientation as orientation_of, rotation, vector } from './kinematics.js';

const UP = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);

const OLD_S = 0.5;     // age of a pose, without the time on the link
const TRANSLUCENT = 0.55;
const TRACKED_MAX = 8;  // kTrackedBodies

const numbers = (element, name) => element.getAttribute(name)?.trim().split(/\s+/).map(Number) ?? null;

/** Orientation of a body or geom; `to_rad` converts the angles of the file. */
function orientation(element, to_rad) {
  const quaternion = numbers(element, 'quat');
  if (quaternion) return new Quaternion(quaternion[1], quaternion[2], quaternion[3], quaternion[0]).normalize();
  const euler = numbers(element, 'euler');
  if (euler) return new Quaternion().setFromEuler(new Euler(...euler.map((a) => a * to_rad), 'XYZ'));
  const turn = numbers(element, 'axisangle');
  if (turn) return new Quaternion().setFromAxisAngle(new Vector3(...turn.slice(0, 3)).normalize(), turn[3] * to_rad);
  const axis = numbers(element, 'zaxis');
  return axis ? new Quaternion().setFromUnitVectors(Z, new Vector3(...axis).normalize()) : new Quaternion();
}

/** Capsules and cylinders are along y in three.js and along z in the file. */
const upright = new Quaternion().setFromUnitVectors(UP, Z);

/** A capsule along y with the distance `length` between the centres of its hemispheres. */
function capsule(radius, length) {
  const outline = new Path().absarc(0, -length / 2, radius, -Math.PI / 2, 0).absarc(0, length / 2, radius, 0, Math.PI / 2);
  return new LatheBufferGeometry(outline.getPoints(8), 24);
}

function geometry_of(kind, size, length) {
  if (kind === 'sphere') return new SphereBufferGeometry(size[0], 32, 20);
  if (kind === 'box') return new BoxBufferGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
  if (kind === 'capsule') return capsule(size[0], length);
  if (kind === 'cylinder') return new CylinderBufferGeometry(size[0], size[0], length, 32);
  return null;
}

function shape(element, material, to_rad) {
  const size = numbers(element, 'size') ?? [0.01];
  const ends = numbers(element, 'fromto');
  const kind = element.getAttribute('type') ?? 'sphere';
  const from = ends && new Vector3(...ends.slice(0, 3));
  const to = ends && new Vector3(...ends.slice(3));
  const geometry = geometry_of(kind, size, ends ? from.distanceTo(to) : 2 * (size[1] ?? 0));
  if (!geometry) return null;
  const mesh = new Mesh(geometry, material);
  if (ends) {
    mesh.position.copy(from).add(to).multiplyScalar(0.5);
    mesh.quaternion.setFromUnitVectors(UP, to.sub(from).normalize());
  } else {
    mesh.position.set(...(numbers(element, 'pos') ?? [0, 0, 0]));
    mesh.quaternion.copy(orientation(element, to_rad));
    if (kind === 'capsule' || kind === 'cylinder') mesh.quaternion.multiply(upright);
  }
  return mesh;
}

function body(element, colors, to_rad) {
  const group = new Group();
  const free = element.querySelector(':scope > freejoint, :scope > joint[type="free"]') !== null;
  const is_tool = element.getAttribute('name') === 'tool';
  const material = new MeshStandardMaterial({ color: is_tool ? colors.link : colors.scene, roughness: 0.7,
    metalness: 0, transparent: free && !is_tool, opacity: free && !is_tool ? TRANSLUCENT : 1 });
  group.position.set(...(numbers(element, 'pos') ?? [0, 0, 0]));
  group.quaternion.copy(orientation(element, to_rad));
  for (const child of element.children) {
    if (child.tagName === 'geom') {
      const mesh = shape(child, material, to_rad);
      if (mesh) group.add(mesh);
    }
    if (child.tagName === 'body') group.add(body(child, colors, to_rad).group);
  }
  return { group, free, is_tool, material, gripped: child_named(element, 'site') };
}

const child_named = (element, tag) => [...element.querySelectorAll(tag)].map((site) => site.getAttribute('name'));

export class Bodies {
  /** `start`: start position of the tool, W, which is the origin of the file. */
  constructor(scene, start, colors) {
    this.group = new Group();
    this.colors = colors;
    this.bodies = [];
    this.tracked = [];
    this.markers = [];     // of reported bodies beyond `tracked`; by number
    const text = scene.bodies?.file?.find((file) => file.name === scene.bodies.mjcf_file)?.text;
    if (!text) return;
    const file = new DOMParser().parseFromString(text, 'text/xml');
    const to_rad = file.querySelector('compiler')?.getAttribute('angle') === 'radian' ? 1 : Math.PI / 180;
    this.group.position.copy(start);
    for (const element of file.querySelectorAll('worldbody > body')) this.bodies.push(body(element, colors, to_rad));
    for (const one of this.bodies) this.group.add(one.group);
    this.tracked = this.bodies.filter((one) => one.free && !one.is_tool);
    this.fixture = scene.bodies.gripper?.fixture;
    this.draw_goal(scene.bodies.goal);
  }

  /** The body at its goal, if the scene has one. */
  draw_goal(goal) {
    const target = goal && this.tracked[(goal.body ?? 1) - 1];
    if (!target) return;
    this.goal = target.group.clone();
    const wires = new MeshBasicMaterial({ color: this.colors.path, wireframe: true, transparent: true, opacity: 0.25 });
    this.goal.traverse((one) => { if (one.material) one.material = wires; });
    this.goal.position.copy(vector(goal.position_m));
    this.goal.quaternion.copy(rotation(goal.rotation_rad ?? [0, 0, 0]));
    this.group.add(this.goal);
  }

  /** Maximum distance of a body from the start position of the tool, m. */
  radius() { return Math.max(0, ...this.bodies.map((one) => one.group.position.length())); }

  /** Updates the bodies for a pose of the tool; `holds`: the gripper holds a body; `poses`: view.bodies; `old`: no data
   * arrives from the robot. */
  follow(tool_m, tool_q, holds, poses, old) {
    this.show_markers(poses, old);
    if (this.bodies.length === 0) return;
    this.start_q ??= tool_q.clone();
    const turn = tool_q.clone().multiply(this.start_q.clone().conjugate());
    const place = tool_m.clone().sub(this.group.position);
    for (const one of this.bodies) {
      if (one.is_tool) {
        one.group.position.copy(place);
        one.group.quaternion.copy(turn);
      }
    }
    this.tracked.forEach((one, i) => {
      const reported = poses?.[`body${i + 1}`];
      this.move(one, reported, old);
      if (!reported && one.gripped.includes(this.fixture)) {
        this.carry(one, place, turn, holds);
      }
    });
  }

  /** Moves a body to its reported pose, if there is one. */
  move(one, reported, old) {
    one.age_s = reported?.age_s ?? null;
    one.material.opacity = reported && !old && reported.age_s < OLD_S ? 1 : TRANSLUCENT;
    if (!reported) return;
    one.group.position.copy(vector(reported.pose.position_m)).sub(this.group.position);
    one.group.quaternion.copy(orientation_of(reported.pose.orientation));
  }

  /** Draws the reported bodies of which the scene has no shape. */
  show_markers(poses, old) {
    for (let number = this.tracked.length + 1; number <= TRACKED_MAX; ++number) {
      const reported = poses?.[`body${number}`];
      if (!reported && !this.markers[number]) continue;
      if (!this.markers[number]) this.group.add((this.markers[number] = new BodyMarker(number, this.colors)).group);
      const marker = this.markers[number];
      marker.group.visible = Boolean(reported);
      this.move(marker, reported, old);
    }
  }

  /** Age of the oldest reported pose, s; null: none is reported. */
  age_s() {
    const ages = [...this.tracked, ...this.markers].map((one) => one?.age_s ?? null).filter((age) => age !== null);
    return ages.length > 0 ? Math.max(...ages) : null;
  }

  carry(one, place, turn, holds) {
    if (!holds) {
      one.held = null;
      return;
    }
    const back = turn.clone().conjugate();
    one.held ??= { p: one.group.position.clone().sub(place).applyQuaternion(back),
      q: back.clone().multiply(one.group.quaternion) };
    one.group.position.copy(one.held.p).applyQuaternion(turn).add(place);
    one.group.quaternion.copy(turn).multiply(one.held.q);
  }
}
