// The page of `longreach view`: connects feed, picture, plots, panel and hand.

import { Feed } from './feed.js';
import { Hand } from './hand.js';
import { rotation, vector } from './kinematics.js';
import { draw_lift, draw_pad, pad_radius } from './pad.js';
import { Panel } from './panel.js';
import { Picture } from './picture.js';
import { Plots } from './plots.js';

const AIM_MS = 25;     // the master releases the handle if no aim arrives for 300 ms
const SCALE_STEP = 0.05;
const KV_STEP = 1.25, KV_MIN = 0.001, KV_MAX = 1000;
const SILENT_S = 0.5;    // after this time the displayed state of the robot is outdated
const COLORS = ['ground', 'card', 'line', 'text', 'quiet', 'operator', 'robot', 'contact', 'good', 'warn', 'third'];

function colors() {
  const style = getComputedStyle(document.documentElement);
  const all = Object.fromEntries(COLORS.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  return { ...all, link: dark ? '#aeb9c6' : '#b9c3cf', scene: dark ? '#7f95ad' : '#8fa3ba',
    soft: dark ? '#a9bdd2' : '#c3d2e2', hard: dark ? '#45586d' : '#52677e', path: all.third };
}

const at = (id) => document.getElementById(id);
let frame = null;
let anchor = null;     // of the current engagement
let task = null;       // progress along the path of the scene
let away = null;       // if there are no frames: state and reason
let dirty = true;
let page_colors = colors();

let picture = null;    // created after the rest of the page is loaded
let lasting = null;    // robot and scene as last received
const plots = new Plots(at('plots'), page_colors);
const hand = new Hand((name) => ask(name));
const panel = new Panel((name, value) => ask(name, value));

/** Current goal of the tool. */
function ghost() {
  const { view } = frame;
  if (!anchor || anchor.engagement !== view.engagement) return null;
  if (frame.state !== 'Engaged' && frame.state !== 'Holding') return null;
  return {
    position: vector(anchor.position_m).add(vector(view.goal_m)),
    quaternion: rotation(view.goal_rad).multiply(rotation(anchor.rotation_rad)),
  };
}

function show_lag(pose) {
  let text = '';
  if (pose && frame.view.far_known) {
    const mm = 1e3 * vector(frame.view.far.tool.position_m).distanceTo(pose.position);
    text = `robot ${mm.toFixed(mm < 10 ? 1 : 0)} mm from its goal`;
  }
  at('lag').textContent = text;
}

/** Progress along the path, as `longreach task path` judges it. */
function show_task() {
  at('task').hidden = task === null;
  if (task === null) return;
  const mm = (m) => `${(1e3 * m).toFixed(1)} mm`;
  const errors = `mean error ${mm(task.mean_error_m)}, largest ${mm(task.max_error_m)}`;
  const passed = `ball ${task.passed} of ${task.balls}`;
  at('task').textContent = {
    AWAY: 'path: bring the tool to the start',
    READY: 'path: the time begins when the tool leaves the start',
    UNDERWAY: `path: ${task.time_s.toFixed(1)} s, ${passed}, now ${mm(task.error_m)} beside it, ${errors}`,
    DONE: `path: target reached after ${task.time_s.toFixed(1)} s, ${errors}`,
  }[task.phase];
}

/** Age of the displayed state of the robot, s; null: unknown. */
function robot_age_s() {
  const { link, view } = frame;
  return view.far_known && link.rtt_known && link.silence_s >= 0 ? link.silence_s + link.rtt_s / 2 : null;
}

/** Shows the age of the poses of free bodies, with half the round-trip time if it is known. */
function show_bodies_age() {
  const age = picture?.bodies?.age_s() ?? null;
  at('bodies-key').hidden = age === null;
  if (age === null) return;
  const there = age + (frame.link.rtt_known ? frame.link.rtt_s / 2 : 0);
  at('bodies-key').textContent = `free bodies, ${there.toFixed(there < 10 ? 1 : 0)} s ago`;
}

function show_age(old) {
  document.body.classList.toggle('old', old);
  const age = robot_age_s();
  at('robot-key').textContent = age === null ? 'robot, as last received' : `robot, ${age.toFixed(age < 10 ? 1 : 0)} s ago`;
  show_bodies_age();
}

const feed = new Feed({
  frame(now) {
    // In rate mode a deflected handle would command a speed immediately.
    const { view } = now;
    if (view.mode === 'RATE' && frame?.view.mode === 'POSITION') hand.home();
    frame = now;
    away = null;
    hand.workspace_m = now.workspace_m;
    hand.rate = view.mode === 'RATE';
    plots.anchor = anchor?.engagement === view.engagement ? anchor.position_m : plots.anchor;
    plots.add(now);
    dirty = true;
  },
  task(now) { task = now; },
  scene(now) {
    lasting = now;
    picture?.build(now);
  },
  anchor(now) { anchor = now; },
  desk(now) {
    if (now.holder === 'you' && !hand.held && frame) hand.take(frame.view.hand_m, frame.view.gripper_closed);
    if (now.holder !== 'you') hand.let_go();
    panel.hold(now);
  },
  said(sentence, message) { panel.say(sentence, message.refused); },
  links(names) { panel.links(names); },
  down(why) { if (why) offline('no master', why); },
  slave_down(why) { if (why) panel.say(why, true); },
  full(why) { offline('full', why); },
  lost(why) { offline('no server', why); },
});

function offline(state, why) {
  hand.let_go();
  panel.hold({ holder: 'nobody', viewers: 1 });
  away = { state, why };
  dirty = true;
  panel.banner(state, why, '');
}

function ask(name, value) {
  const scale_to = (by) => Math.round((frame.view.scale + by) / SCALE_STEP) * SCALE_STEP;
  const asks = {
    take: () => feed.send({ take: !hand.held }),
    engage: () => feed.send({ do: 'engage' }),
    stop: () => feed.send({ do: 'stop' }),
    mode: () => feed.send({ mode: value ?? (frame.view.mode === 'RATE' ? 'position' : 'rate') }),
    scale: () => feed.send({ scale: value }),
    scale_up: () => feed.send({ scale: Math.min(scale_to(SCALE_STEP), 1) }),
    scale_down: () => feed.send({ scale: Math.max(scale_to(-SCALE_STEP), SCALE_STEP) }),
    kv_up: () => feed.send({ kv: Math.min(frame.view.kv_per_s * KV_STEP, KV_MAX) }),
    kv_down: () => feed.send({ kv: Math.max(frame.view.kv_per_s / KV_STEP, KV_MIN) }),
    link: () => feed.send({ link: value }),
    clutch: () => { hand.clutch = !hand.clutch; },
    grip: () => { hand.grip = !hand.grip; },
    home: () => hand.home(),
    camera: () => picture?.choose(value),
    untaken: () => panel.say('take control first, then drag here', false),
  };
  if (!frame && name !== 'stop' && name !== 'camera') return;
  asks[name]?.();
  dirty = true;
}

addEventListener('keydown', (event) => {
  if (event.target.closest?.('select, input') && event.key !== 'x') return;
  if (event.target.closest?.('button, summary') && event.key === ' ') return;
  if (hand.key(event)) event.preventDefault();
});
// After a click with the pointer, the keys belong to the hand again: the space key brings it home.
addEventListener('click', (event) => { if (event.detail > 0) event.target.closest?.('button')?.blur(); });
hand.follow(at('pad'), () => pad_radius(at('pad')), { across: 1, up: 0 });
hand.follow(at('lift'), () => (0.9 * at('lift').clientHeight) / 2, { up: 2 });
setInterval(() => {
  if (hand.held) feed.send({ aim: hand.aim_m, turn: hand.turn_rad, clutch: hand.clutch, grip: hand.grip });
}, AIM_MS);

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  page_colors = colors();
  picture?.paint(page_colors);
  plots.paint(page_colors);
});
new ResizeObserver(() => { dirty = true; }).observe(at('picture'));

/** Creating the picture takes longest, so it starts after the rest of the page is loaded. */
function begin_picture() {
  picture = new Picture(at('space'), page_colors);
  picture.on_inset = ({ width, height, margin }) => {
    Object.assign(at('inset').style, { left: `${margin}px`, bottom: `${margin}px`, width: `${width}px`, height: `${height}px` });
  };
  for (const orbit of [picture.orbit, picture.orbit_whole]) orbit.addEventListener('change', () => { dirty = true; });
  if (lasting) picture.build(lasting);
}
addEventListener('load', () => setTimeout(begin_picture, 0));

let rate_ms = 0;
let drawn_ms = 0;
let took_ms = 0; // drawing time of the last picture

function draw(now_ms) {
  requestAnimationFrame(draw);
  // Leaves at least half of the time to the feed and the controls, even for large scenes.
  if (!dirty || !frame || now_ms - drawn_ms < Math.max(picture?.pause_ms ?? 0, 2 * took_ms)) return;
  dirty = false;
  drawn_ms = now_ms;
  const pose = ghost();
  const old = away !== null || !(frame.link.silence_s >= 0 && frame.link.silence_s < SILENT_S);
  const begun_ms = performance.now();
  picture?.show(frame, pose, old, task);
  show_age(old);
  picture?.draw();
  took_ms = performance.now() - begun_ms;
  plots.draw(now_ms);
  panel.show(frame, hand);
  if (away) panel.banner(away.state, away.why, '');
  draw_pad(at('pad'), frame, hand, page_colors);
  draw_lift(at('lift'), frame, hand, page_colors);
  show_lag(pose);
  show_task();
  if (now_ms - rate_ms > 500) {
    rate_ms = now_ms;
    at('rate').textContent = `${feed.rate_hz().toFixed(0)} updates per second`;
  }
}
requestAnimationFrame(draw);

// For tests and debugging.
window.longreach = { feed, hand, picture: () => picture, frame: () => frame, view: () => frame?.view,
  anchor: () => anchor, task: () => task };
