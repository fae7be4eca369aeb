// The banner, the controls and the force bars: they display a frame and send the requests of the user.

const by_id = (id) => document.getElementById(id);
const number = (x, digits) => (Number.isFinite(x) ? x.toFixed(digits) : '–');
const percent = (x) => (Number.isFinite(x) ? `${(100 * x).toFixed(1)} %` : '–');

const age = (s) => (s >= 0.1 ? ` (${s.toFixed(1)} s ago)` : '');

/** Changes the page only if the text differs. */
function write(id, text) {
  const element = by_id(id);
  if (element.textContent !== text) element.textContent = text;
}

export class Panel {
  /** `ask(name, value)`: engage, stop, take, mode, scale, kv_up, kv_down, clutch, grip, link, camera. */
  constructor(ask) {
    this.ask = ask;
    this.holder = 'nobody';
    for (const id of ['engage', 'stop', 'take', 'kv_up', 'kv_down', 'clutch', 'grip']) by_id(id).addEventListener('click', () => ask(id));
    for (const button of document.querySelectorAll('[data-mode]'))
      button.addEventListener('click', () => ask('mode', button.dataset.mode));
    for (const button of document.querySelectorAll('[data-camera]'))
      button.addEventListener('click', () => this.choose_camera(button.dataset.camera));
    const scale = by_id('scale');
    scale.addEventListener('input', () => { write('scale-now', Number(scale.value).toFixed(2)); });
    scale.addEventListener('change', () => ask('scale', Number(scale.value)));
    const link = by_id('link');
    link.addEventListener('change', () => { if (link.value) ask('link', link.value); });
    this.hold({ holder: 'nobody', viewers: 1 });
  }

  choose_camera(name) {
    for (const button of document.querySelectorAll('[data-camera]'))
      button.setAttribute('aria-pressed', String(button.dataset.camera === name));
    this.ask('camera', name);
  }

  /** Shows which page has control: nobody (none), you (this page), other. */
  hold({ holder, viewers }) {
    this.holder = holder;
    const mine = holder === 'you';
    const take = by_id('take');
    take.classList.toggle('held', mine);
    take.textContent = mine ? 'Return control' : 'Take control';
    take.disabled = holder === 'other';
    by_id('reach').classList.toggle('held', mine);
    for (const element of document.querySelectorAll('#controls button, #controls input, #controls select'))
      element.disabled = !mine;
    const pages = viewers === 1 ? '' : ` · ${viewers} pages are observing`;
    write('holder', (mine ? 'you have control' : holder === 'other' ? 'another page has control' : 'you are observing') + pages);
  }

  /** Called at every connection. */
  links(names) {
    const link = by_id('link');
    const chosen = link.value;
    link.length = 1; // "as started"
    link.append(...names.map((name) => new Option(name, name)));
    link.value = names.includes(chosen) ? chosen : '';
  }

  show(frame, hand) {
    const { view } = frame;
    const mode = view.mode.toLowerCase();
    this.banner(frame.state, frame.happening, frame.clamped.join(' · '));
    write('rtt', frame.link.rtt_known ? `${frame.link.rtt_s.toFixed(frame.link.rtt_s < 0.1 ? 3 : 2)} s` : '–');
    write('loss', `${percent(view.far.up_loss)} / ${percent(frame.link.loss)}`);
    write('now-mode', mode === 'rate' ? `rate × ${number(view.kv_per_s, 2)}/s` : `position × ${number(view.scale, 2)}`);
    for (const button of document.querySelectorAll('[data-mode]'))
      button.setAttribute('aria-pressed', String(button.dataset.mode === mode));
    const scale = by_id('scale');
    if (document.activeElement !== scale || !scale.matches(':active')) {
      scale.value = view.scale;
      write('scale-now', number(view.scale, 2));
    }
    write('kv-now', number(view.kv_per_s, 2));
    by_id('clutch').setAttribute('aria-pressed', String(hand.held ? hand.clutch : view.clutched));
    by_id('grip').setAttribute('aria-pressed', String(view.gripper_closed));
    write('engage', frame.state === 'Engaged' ? 'Engaged' : 'Engage');
    by_id('engage').disabled = this.holder !== 'you' || frame.state === 'Engaged';
    this.felt(frame, hand);
    write('reduced', frame.reduced_protection.map((sentence) => `Reduced protection: ${sentence}`).join(' · '));
  }

  felt({ force_max_n, far_age_s, view }, hand) {
    const { force_n, moment_nm } = view.wrench;
    const [x, y, z] = view.hand_m.map((m) => (1e3 * m).toFixed(1));
    const turned = Math.hypot(...hand.turn_rad) * (180 / Math.PI);
    write('where', `x ${x}   y ${y}   z ${z} mm${turned > 0.05 ? `   rotated by ${turned.toFixed(1)}°` : ''}`);
    ['x', 'y', 'z'].forEach((name, i) => {
      const share = Math.max(-1, Math.min(1, force_n[i] / force_max_n));
      // A nonlinear scale, so that small forces are visible.
      const width = 50 * Math.abs(share) ** 0.7;
      const bar = by_id(`felt-${name}`).style;
      bar.width = `${width.toFixed(1)}%`;
      bar.left = share < 0 ? `${(50 - width).toFixed(1)}%` : '50%';
    });
    write('felt-n', `${number(Math.hypot(...force_n), 2)} N`);
    const k = view.stiffness_n_per_m;
    const turning = view.rotational_stiffness_nm_per_rad;
    const felt = [];
    if (k > 0) felt.push(`${number(1e-3 * k, 2)} N/mm`);
    if (turning > 0) felt.push(`${number(turning, 2)} N m/rad`);
    write('felt-k', felt.join(', ') || '–');
    write('felt-nm', `${number(1e3 * Math.hypot(...moment_nm), 0)} mN m`);
    write('tool-n', view.far_known ? `${number(Math.hypot(...view.far.wrench.force_n), 1)} N${age(far_age_s)}` : '–');
    write('tool-nm', view.far_known ? `${number(Math.hypot(...view.far.wrench.moment_nm), 2)} N m` : '–');
  }

  banner(state, sentence, clamped) {
    by_id('banner').dataset.state = state;
    write('state', state);
    write('happening', sentence);
    write('clamped', clamped);
  }

  /** Shows a message for a few seconds. */
  say(sentence, refused) {
    const box = by_id('said');
    box.textContent = sentence;
    box.className = refused ? 'shown refused' : 'shown';
    clearTimeout(this.saying);
    this.saying = setTimeout(() => { box.className = ''; }, refused ? 6000 : 2500);
  }
}
