// The hand of the page: the target of the handle, from pointer, wheel, touch and keys. This module sends nothing;
// `aim_m` is the current target. The keys are the same as in the terminal.

export const STEP_M = 0.001;
export const LARGE_STEP_M = 0.005;
export const STEP_RAD = 0.01;
export const LARGE_STEP_RAD = 0.05;
const TURN_MAX_RAD = 0.5;

const MOVES = {
  w: [0, 1], arrowup: [0, 1], s: [0, -1], arrowdown: [0, -1],
  a: [1, 1], arrowleft: [1, 1], d: [1, -1], arrowright: [1, -1],
  r: [2, 1], pageup: [2, 1], f: [2, -1], pagedown: [2, -1],
};
const TURNS = { u: [0, 1], o: [0, -1], i: [1, 1], k: [1, -1], j: [2, 1], l: [2, -1] };
const ACTIONS = { ' ': 'home', m: 'mode', '+': 'scale_up', '=': 'scale_up', '-': 'scale_down', _: 'scale_down', '.': 'kv_up', '>': 'kv_up',
  ',': 'kv_down', '<': 'kv_down', c: 'clutch',
  g: 'grip', e: 'engage', x: 'stop', t: 'take' };

export class Hand {
  /** `act(name)` handles keys that do not move the handle. */
  constructor(act) {
    this.act = act;
    this.held = false;
    this.aim_m = [0, 0, 0];
    this.turn_rad = [0, 0, 0];
    this.workspace_m = 0.075;
    this.clutch = false;
    this.grip = false;
    this.rate = false;     // rate mode: the handle returns home when the pointer releases it
    this.dragging = false;
  }

  take(hand_m, gripping) {
    this.held = true;
    this.aim_m = [...hand_m];
    this.turn_rad = [0, 0, 0];
    this.clutch = false;
    this.grip = gripping;
  }

  let_go() {
    this.held = false;
    this.clutch = false;
  }

  home() {
    this.aim_m = [0, 0, 0];
    this.turn_rad = [0, 0, 0];
  }

  turn(axis, by_rad) {
    if (!this.held) return;
    this.turn_rad[axis] = Math.max(-TURN_MAX_RAD, Math.min(TURN_MAX_RAD, this.turn_rad[axis] + by_rad));
  }

  move(axis, by_m) {
    if (!this.held) return;
    this.aim_m[axis] += by_m;
    const norm = Math.hypot(...this.aim_m);
    if (norm > this.workspace_m) this.aim_m = this.aim_m.map((x) => (x * this.workspace_m) / norm);
  }

  /** Returns true if the page uses this key. */
  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return false;
    const name = event.key.toLowerCase();
    const move = MOVES[name];
    if (move) {
      this.move(move[0], move[1] * (event.shiftKey ? LARGE_STEP_M : STEP_M));
      return this.held;
    }
    const turn = TURNS[name];
    if (turn) {
      this.turn(turn[0], turn[1] * (event.shiftKey ? LARGE_STEP_RAD : STEP_RAD));
      return this.held;
    }
    const action = ACTIONS[name];
    if (!action || event.repeat) return Boolean(action);
    this.act(action);
    return true;
  }

  /** Dragging on `canvas` moves the handle: `axes.across` and `axes.up` are the axes of horizontal and vertical motion. */
  follow(canvas, radius_px, axes) {
    let last = null;
    let turns = false;     // the right button rotates the handle
    canvas.addEventListener('pointerdown', (event) => {
      if (!this.held) return this.act('untaken');
      canvas.setPointerCapture(event.pointerId);
      last = [event.clientX, event.clientY];
      turns = event.button === 2;
      this.dragging = true;
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!last) return;
      const m_per_px = this.workspace_m / radius_px();
      const fine = event.shiftKey ? 0.2 : 1;
      if (turns && axes.across !== undefined) {
        const rad_per_px = TURN_MAX_RAD / radius_px();
        this.turn(2, -(event.clientX - last[0]) * rad_per_px * fine);
        this.turn(1, (event.clientY - last[1]) * rad_per_px * fine);
        last = [event.clientX, event.clientY];
        return;
      }
      if (axes.across !== undefined) this.move(axes.across, -(event.clientX - last[0]) * m_per_px * fine);
      this.move(axes.up, -(event.clientY - last[1]) * m_per_px * fine);
      last = [event.clientX, event.clientY];
    });
    const end = () => {
      if (last && this.rate) this.home();
      last = null;
      this.dragging = false;
    };
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture']) canvas.addEventListener(name, end);
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.move(2, -Math.sign(event.deltaY) * STEP_M);
    }, { passive: false });
  }
}
