// The surfaces and the path of a scene (proto/config_scene.proto, message Scene). A body turns red while the tool touches it
// and stays tinted afterwards. A ball at each turning point of the path turns red when the tool has passed it.

import { BoxBufferGeometry, BufferGeometry, CylinderBufferGeometry, DoubleSide, EdgesGeometry, GridHelper, Group, Line,
  LineBasicMaterial, LineSegments, Mesh, MeshStandardMaterial, PlaneBufferGeometry, SphereBufferGeometry, Vector3 }
  from 'three';

import { rotation, vector } from './kinematics.js';

const UP = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);
const WALL_M = 0.3;
const EDGES_MAX = 500; // maximum number of surfaces for which the edges of boxes are drawn, since edges double the cost

const from_start = (part, numbers, start) => {
  const p = vector(numbers);
  return part.from_tool_start ? p.add(start) : p;
};

function plane(shape, start, material, colors) {
  const normal = vector(shape.normal).normalize();
  const point = from_start(shape, shape.point_m, start);
  // Draws the part of the plane that is nearest to the start position of the tool.
  const centre = start.clone().addScaledVector(normal, point.clone().sub(start).dot(normal));
  const wall = new Mesh(new PlaneBufferGeometry(WALL_M, WALL_M), material);
  wall.position.copy(centre);
  wall.quaternion.setFromUnitVectors(Z, normal);
  const grid = new GridHelper(WALL_M, 10, colors.quiet, colors.quiet);
  Object.assign(grid.material, { transparent: true, opacity: 0.3 });
  grid.rotation.x = Math.PI / 2;
  wall.add(grid);
  // Draws the plane behind its grid, regardless of the rounding of depths.
  Object.assign(material, { side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  return { mesh: wall, distance: (p) => p.clone().sub(point).dot(normal) };
}

function sphere(shape, start, material) {
  const centre = from_start(shape, shape.centre_m, start);
  const mesh = new Mesh(new SphereBufferGeometry(shape.radius_m, 40, 24), material);
  mesh.position.copy(centre);
  return { mesh, distance: (p) => p.distanceTo(centre) - shape.radius_m };
}

function box(shape, start, material) {
  const centre = from_start(shape, shape.centre_m, start);
  const size = shape.size_m.length === 3 ? vector(shape.size_m) : new Vector3(0.04, 0.04, 0.04);
  const mesh = new Mesh(new BoxBufferGeometry(size.x, size.y, size.z), material);
  mesh.position.copy(centre);
  mesh.quaternion.copy(rotation(shape.rotation_rad));
  const inverse = mesh.quaternion.clone().conjugate();
  return {
    mesh,
    distance: (p) => {
      const local = p.clone().sub(centre).applyQuaternion(inverse);
      const out = new Vector3(Math.abs(local.x), Math.abs(local.y), Math.abs(local.z)).addScaledVector(size, -0.5);
      const inside = Math.min(Math.max(out.x, out.y, out.z), 0);
      return out.max(new Vector3()).length() + inside;
    },
  };
}

function cylinder(shape, start, material) {
  const centre = from_start(shape, shape.centre_m, start);
  const axis = shape.axis.length === 3 ? vector(shape.axis).normalize() : Z.clone();
  const mesh = new Mesh(new CylinderBufferGeometry(shape.radius_m, shape.radius_m, shape.length_m, 40), material);
  mesh.position.copy(centre);
  mesh.quaternion.setFromUnitVectors(UP, axis);
  return {
    mesh,
    distance: (p) => {
      const local = p.clone().sub(centre);
      const height = local.dot(axis);
      const radial = local.addScaledVector(axis, -height).length() - shape.radius_m;
      const axial = Math.abs(height) - shape.length_m / 2;
      return Math.min(Math.max(radial, axial), 0) + Math.hypot(Math.max(radial, 0), Math.max(axial, 0));
    },
  };
}

/** Colour of a material. Stiffer materials are darker, from 100 N/m to 1e6 N/m. */
function shade(scene, name, colors) {
  const k = scene.material?.find((one) => one.name === name)?.stiffness_n_per_m ?? 1000;
  const share = Math.min(Math.max((Math.log10(k) - 2) / 4, 0), 1);
  return colors.soft.clone().lerp(colors.hard, share);
}

const BALL_M = 0.006;
const CHORDS = 16; // of a quarter turn; even, because a ball is at its middle

const SHAPES = { plane, sphere, box, cylinder };

/** Points of the path: straight segments with quarter turns of the path's radius between them; the middles of the turns go to
 * `balls`. */
function path_points(path, start, balls) {
  const points = path.waypoint.map((w) => from_start(path, w.point_m, start));
  const out = [points[0]];
  for (let i = 1; i + 1 < points.length; ++i) {
    const before = points[i - 1].clone().sub(points[i]).normalize();
    const after = points[i + 1].clone().sub(points[i]).normalize();
    const r = path.turn_radius_m;
    const centre = points[i].clone().addScaledVector(before, r).addScaledVector(after, r);
    for (let k = 0; k <= CHORDS; ++k) {
      const angle = (k / CHORDS) * (Math.PI / 2);
      out.push(centre.clone().addScaledVector(after, -r * Math.cos(angle)).addScaledVector(before, -r * Math.sin(angle)));
      if (k === CHORDS / 2) balls.push(out.at(-1));
    }
  }
  out.push(points.at(-1));
  return out;
}

export class Scenery {
  /** `start`: start position of the tool, W. */
  constructor(scene, start, colors) {
    this.group = new Group();
    this.tool_radius_m = scene.tool_radius_m ?? 0;
    this.red = colors.contact;
    this.bodies = [];
    for (const surface of scene.surface ?? []) {
      // The configuration contains all shapes. The actual shape is the one that has a position.
      const kind = Object.keys(SHAPES).find((name) => surface[name]?.centre_m?.length || surface[name]?.point_m?.length);
      if (!kind) continue;     // a hinge has no position
      const plain = shade(scene, surface.material, colors);
      const material = new MeshStandardMaterial({ color: plain, roughness: 0.8, metalness: 0,
        transparent: kind === 'plane', opacity: kind === 'plane' ? 0.35 : 1 });
      const body = SHAPES[kind](surface[kind], start, material, colors);
      this.bodies.push({ ...body, material, plain, solid: kind !== 'plane', touched: false });
      if (kind === 'box' && scene.surface.length <= EDGES_MAX)
        body.mesh.add(new LineSegments(new EdgesGeometry(body.mesh.geometry), new LineBasicMaterial({ color: colors.line })));
      this.group.add(body.mesh);
    }
    this.balls = [];
    if (scene.path?.waypoint?.length > 1) {
      const turns = [];
      const line = new BufferGeometry().setFromPoints(path_points(scene.path, start, turns));
      this.group.add(new Line(line, new LineBasicMaterial({ color: colors.path })));
      this.ball_color = colors.path;
      for (const turn of turns) {
        const ball = new Mesh(new SphereBufferGeometry(BALL_M, 24, 16),
          new MeshStandardMaterial({ color: colors.path, roughness: 0.8, metalness: 0 }));
        ball.position.copy(turn);
        this.balls.push(ball);
        this.group.add(ball);
      }
    }
  }

  /** Extent of the scene from the start position of the tool, m. */
  radius(start) {
    let reach = 0.25;
    for (const ball of this.balls) reach = Math.max(reach, ball.position.distanceTo(start) + 0.05);
    for (const { mesh, solid } of this.bodies) {
      if (solid) reach = Math.max(reach, mesh.position.distanceTo(start) + 0.05);
    }
    return Math.min(reach, 3);
  }

  /** The tool has passed the first `count` balls of the path. */
  pass(count) {
    this.balls.forEach((ball, i) => ball.material.color.copy(i < count ? this.red : this.ball_color));
  }

  /** `contact`: the slave detects a contact at the tool. */
  touch(tool_m, contact) {
    let nearest = null;
    if (contact) {
      const by_distance = this.bodies.map((body) => ({ body, d: body.distance(tool_m) - this.tool_radius_m }));
      nearest = by_distance.reduce((a, b) => (a && a.d <= b.d ? a : b), null)?.body;
    }
    for (const body of this.bodies) {
      const now = body === nearest;
      if (now && body.solid) body.touched = true;
      const share = now ? 1 : body.touched ? 0.75 : 0;
      body.material.color.copy(body.plain).lerp(this.red, body.solid ? share : 0.6 * share);
    }
  }
}

/** A grid on the ground for orientation. */
export function ground(size, colors) {
  const grid = new GridHelper(size, 20, colors.line, colors.line);
  grid.rotation.x = Math.PI / 2;
  return grid;
}
