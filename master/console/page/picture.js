// The 3D picture: arm, scene, ghost, trails, contact arrows, workspace. It has two cameras, one near the tool and one
// for the whole arm. The view of the camera that is not selected is an inset in the corner. The picture is drawn when
// its contents change.

import { AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, Group, HemisphereLight, Line,
  LineBasicMaterial, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene, SphereBufferGeometry, Vector2, Vector3,
  WebGLRenderer } from 'three';
import { OrbitControls } from 'OrbitControls';

import { Arm, ring } from './arm.js';
import { Arrow } from './arrow.js';
import { Bodies } from './bodies.js';
import { orientation, start_frame, vector } from './kinematics.js';
import { Scenery, ground } from './scenery.js';

const TRAIL_POINTS = 1800;     // 30 s at 60 Hz
const GAMMA = 2.2;     // of the screen; lighting is computed in linear colours
const INSET = { width: 0.24, margin: 12 };

/** Returns true if the processor renders the picture, which leaves it little time for other work. */
function drawn_in_software() {
  const gl = document.createElement('canvas').getContext('webgl');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** Lets pointer and wheel rotate, pan and zoom the camera. */
function orbit(camera, canvas) {
  // OrbitControls zooms by the number of events. Here the zoom depends on the distance that the wheel turns.
  canvas.addEventListener('wheel', ({ deltaY, deltaMode }) => {
    controls.zoomSpeed = Math.abs(deltaY) * (deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 0.01 : 0.16);
  });
  const controls = new OrbitControls(camera, canvas);
  controls.addEventListener('end', () => { controls.zoomSpeed = 1; });
  // The keys move the handle.
  return Object.assign(controls, { screenSpacePanning: true, enableKeys: false });
}

const linear = (color) => new Color(color).convertGammaToLinear(GAMMA);

class Trail {
  constructor(color) {
    this.positions = new Float32Array(3 * TRAIL_POINTS);
    this.count = 0;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.positions, 3));
    this.line = new Line(geometry, new LineBasicMaterial({ color }));
    this.line.frustumCulled = false;
    this.clear();
  }

  clear() {
    this.count = 0;
    this.line.geometry.setDrawRange(0, 0);
  }

  add(p) {
    if (this.count === TRAIL_POINTS) {
      this.positions.copyWithin(0, 3);
      this.count -= 1;
    }
    p.toArray(this.positions, 3 * this.count);
    this.count += 1;
    this.line.geometry.attributes.position.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
  }
}

export class Picture {
  constructor(canvas, colors) {
    this.canvas = canvas;
    this.slow = drawn_in_software();
    this.pause_ms = this.slow ? 140 : 0;     // between two pictures
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.slow, alpha: true });
    // Physical light units: a white surface reflects 1/π of the irradiance.
    Object.assign(this.renderer, { gammaOutput: true, gammaFactor: GAMMA, physicallyCorrectLights: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.near = new PerspectiveCamera(38, 1, 0.005, 200);
    this.whole = new PerspectiveCamera(38, 1, 0.05, 500);
    for (const camera of [this.near, this.whole]) camera.up.set(0, 0, 1);
    this.orbit = orbit(this.near, canvas);
    this.orbit_whole = orbit(this.whole, canvas);
    this.choose('tool');
    this.lasting = null;     // {robot, scene} as last received
    this.last = null;        // frame and ghost as last shown
    this.paint(colors);
  }

  /** Sets the colours and builds the picture again. */
  paint(colors) {
    this.renderer.setClearColor(new Color(colors.card), 1);     // not converted by the renderer
    this.colors = Object.fromEntries(Object.entries(colors).map(([name, color]) => [name, linear(color)]));
    if (this.lasting) this.build(this.lasting);
  }

  choose(name) {
    this.chosen = name;
    this.orbit.enabled = name === 'tool';
    this.orbit_whole.enabled = name === 'arm';
  }

  build(lasting) {
    const first = !this.lasting;
    this.lasting = lasting;
    const { robot, scene, workspace_m } = lasting;
    const start = new Vector3().setFromMatrixPosition(start_frame(robot));
    this.start = start;
    this.space = new Scene();
    this.space.add(new AmbientLight(0xffffff, 0.9), new HemisphereLight(0xffffff, linear(0x8899aa), 1.1));
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(-4, -6, 9);
    this.space.add(sun);
    this.arm = new Arm(robot, scene.tool_radius_m ?? 0, this.colors);
    this.scenery = new Scenery(scene, start, this.colors);
    this.bodies = new Bodies(scene, start, this.colors);
    this.reported = ring(Math.max(2.2 * (scene.tool_radius_m ?? 0), 0.014), this.colors.robot);
    this.workspace = new Mesh(new SphereBufferGeometry(workspace_m || 3, 28, 16),
      new MeshBasicMaterial({ color: this.colors.line, wireframe: true, transparent: true, opacity: 0.22 }));
    this.workspace.position.copy(start);
    this.trails = { robot: new Trail(this.colors.robot), operator: new Trail(this.colors.operator),
      task: new Trail(this.colors.contact) };
    this.measured = new Arrow(this.colors.contact);
    this.rendered = new Arrow(this.colors.operator);
    this.overview = new Group();
    this.overview.add(ground(2 * Math.ceil(start.length() * 0.8), this.colors), this.workspace);
    this.space.add(this.arm.group, this.arm.ghost, this.scenery.group, this.bodies.group, this.reported, this.trails.robot.line,
      this.trails.operator.line, this.trails.task.line, this.measured.group, this.rendered.group, this.overview);
    if (first) this.frame_cameras();
  }

  frame_cameras() {
    const reach = Math.min(Math.max(this.scenery.radius(this.start), 0.8 * this.bodies.radius()), 3);
    this.near.position.copy(this.start).add(new Vector3(-0.55, -1.95, 0.85).multiplyScalar(reach));
    this.orbit.target.copy(this.start).add(new Vector3((this.bodies.radius() > 0 ? 0.45 : 0.2) * reach, 0, 0));
    const size = Math.max(this.start.length(), 0.6);
    this.whole.position.set(0.15 * size, -1.75 * size, 0.75 * size);
    this.orbit_whole.target.copy(this.start).multiplyScalar(0.5);
    this.orbit.update();
    this.orbit_whole.update();
  }

  /** `ghost`: current goal of the tool, or null. `old`: no data arrives from the robot. `task`: progress along the path, or
   * null. */
  show({ view }, ghost, old, task) {
    if (!this.lasting || !view.far_known) return;
    const { far } = view;
    this.arm.set(far.joint_rad);
    this.arm.set_ghost(ghost);
    const tool = vector(far.tool.position_m);
    const force = vector(far.wrench.force_n);
    this.reported.position.copy(vector(far.goal.position_m));
    this.reported.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), this.arm.approach);
    this.trails.robot.add(tool);
    if (ghost) this.trails.operator.add(ghost.position);
    this.scenery.touch(tool, view.in_contact);
    this.follow_task(task, tool);
    this.bodies.follow(tool, orientation(far.tool.orientation), far.load, view.bodies, old);
    // Offsets, because the arrows would otherwise overlap.
    const aside = new Vector3(0, 0, 0.012);
    this.measured.show(tool.clone().add(aside), view.in_contact ? force : new Vector3(), old);
    this.rendered.show((ghost?.position ?? tool).clone().addScaledVector(aside, 2), vector(view.spring_force_n));
    const outside = this.outside = far.clamps.workspace || far.clamps.unreachable;
    this.workspace.material.color.set(outside ? this.colors.contact : this.colors.line);
    this.workspace.material.opacity = outside ? 0.6 : 0.22;
  }

  /** The trajectory of an attempt, every millimetre, and the balls that were passed. */
  follow_task(task, tool) {
    this.scenery.pass(task?.phase === 'READY' ? 0 : task?.passed ?? 0);
    if (task?.phase === 'READY') {
      this.trails.task.clear();
      this.drawn = null;
    }
    if (task?.phase !== 'UNDERWAY' || this.drawn?.distanceTo(tool) < 0.001) return;
    this.trails.task.add(tool);
    this.drawn = tool.clone();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    const size = this.renderer.getSize(new Vector2());
    if (size.x !== clientWidth || size.y !== clientHeight) this.renderer.setSize(clientWidth, clientHeight, false);
    return { width: clientWidth, height: clientHeight };
  }

  view(camera, overview, x, y, width, height) {
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    this.overview.visible = overview;
    // From inside, the wires of the sphere would hide the robot.
    const radius = this.workspace.geometry.parameters.radius;
    this.workspace.visible = this.outside || camera.position.distanceTo(this.start) > 1.05 * radius;
    this.renderer.setViewport(x, y, width, height);
    this.renderer.setScissor(x, y, width, height);
    this.renderer.render(this.space, camera);
  }

  draw() {
    if (!this.lasting) return;
    const { width, height } = this.resize();
    const near_is_large = this.chosen === 'tool';
    this.renderer.setScissorTest(true);
    this.view(near_is_large ? this.near : this.whole, !near_is_large, 0, 0, width, height);
    const w = Math.round(Math.max(150, INSET.width * width));
    const h = Math.round(0.68 * w);
    this.on_inset?.({ ...INSET, width: w, height: h });
    this.view(near_is_large ? this.whole : this.near, near_is_large, INSET.margin, INSET.margin, w, h);
  }
}
