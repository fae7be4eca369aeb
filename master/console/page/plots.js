// The live plots: the last half minute, drawn some times a second. What the operator commands is blue, what the robot has
// reported is orange, as in the picture.

import uPlot from 'uplot';

const SPAN_S = 30;
const SAMPLE_S = 0.05;
const DRAW_MS = 66;

const last_of = (frame, far, none = null) => (frame.far ? far(frame.far) : none);
const axis_of = (p, axis) => p?.[axis] ?? null;

/** name, unit, and its lines: name, colour, value of a frame and the anchor. */
const PLOTS = [
  { name: 'Position', unit: 'mm', axis: true, lines: [
    ['goal', 'operator', (f, s) => 1e3 * axis_of(f.goal_m, s.axis)],
    ['measured', 'robot', (f, s) => (s.anchor && f.far ? 1e3 * (f.far.tool_m[s.axis] - s.anchor[s.axis]) : null)] ] },
  { name: 'Force', unit: 'N', lines: [
    ['hand', 'operator', (f) => Math.hypot(...f.force_n)],
    ['tool', 'robot', (f) => last_of(f, (far) => Math.hypot(...far.force_n))] ] },
  { name: 'Stiffness', unit: 'N/mm', lines: [
    ['felt', 'operator', (f) => 1e-3 * f.stiffness_n_per_m],
    ['estimated', 'robot', (f) => last_of(f, (far) => 1e-3 * far.stiffness_n_per_m)] ] },
  { name: 'Energy', unit: 'mJ', lines: [
    ['net, into the hand', 'operator', (f) => 1e3 * f.energy_j] ] },
  { name: 'Link', unit: '', lines: [
    ['round trip, s', 'operator', (f) => (f.link.rtt_known ? f.link.rtt_s : null)],
    ['lost, %', 'contact', (f) => 100 * Math.max(f.link.loss, f.up_loss ?? 0), 'percent'] ] },
];

function options(plot, colors, size) {
  const small = '11px system-ui, sans-serif';
  const scale_of = (line) => line[3] ?? 'y';
  const axis = (scale, side, color) => ({
    scale, side, stroke: color, font: small, size: 40, gap: 3, ticks: { size: 3, stroke: colors.line },
    grid: { stroke: colors.line, width: 1, show: side === 3 }, values: (u, all) => all.map((v) => +v.toPrecision(4)),
  });
  const room = (least, zero) => (u, low, high) => {
    if (low === null) return zero ? [0, least] : [-least, least];
    const [from, to] = zero ? [0, Math.max(high, least)] : [low, high];
    const middle = (from + to) / 2;
    const half = Math.max((to - from) * 0.55, least / 2);
    return zero ? [0, to * 1.1] : [middle - half, middle + half];
  };
  // Seconds before the newest sample.
  const ago = { ...axis('x', 2, colors.quiet), size: 17, gap: 2, splits: (u, i, low, high) => [3, 2, 1, 0].map((n) => high - (n * SPAN_S) / 3),
    values: (u, all) => all.map((t) => `${Math.round(t - all.at(-1))}${t === all.at(-1) ? ' s' : ''}`) };
  const axes = [ago, axis('y', 3, plot.lines.length > 1 && plot.lines[1][3] ? colors[plot.lines[0][1]] : colors.quiet)];
  const scales = { x: { time: false, range: (u, low, high) => [high - SPAN_S, high] },
    y: { range: room(plot.name === 'Position' ? 2 : plot.name === 'Energy' ? 2 : 1, plot.name === 'Force'
      || plot.name === 'Stiffness' || plot.name === 'Link') } };
  if (plot.lines.some((line) => line[3])) {
    axes.push(axis('percent', 1, colors.contact));
    scales.percent = { range: room(5, true) };
  }
  return {
    ...size, pxAlign: 0, cursor: { show: false }, legend: { show: false }, scales, axes, padding: [6, plot.lines.some((l) => l[3]) ? 0 : 10, 0, 0],
    series: [{}, ...plot.lines.map((line) => ({ label: line[0], stroke: colors[line[1]], width: 1.6,
      scale: scale_of(line), points: { show: false } }))],
  };
}

export class Plots {
  constructor(root, colors) {
    this.root = root;
    this.axis = 0;
    this.anchor = null;
    this.clear();
    this.paint(colors);
    new ResizeObserver(() => this.resize()).observe(root);
  }

  clear() {
    this.samples = [];
    this.times = [];
    this.columns = PLOTS.map((plot) => plot.lines.map(() => []));
    this.next_s = -Infinity;
    this.drawn_ms = 0;
  }

  paint(colors) {
    this.colors = colors;
    this.root.replaceChildren();
    this.plots = PLOTS.map((plot, i) => {
      const box = document.createElement('div');
      const title = document.createElement('h3');
      title.textContent = plot.name;
      if (plot.unit) title.insertAdjacentHTML('beforeend', ` <small>${plot.unit}</small>`);
      if (plot.axis) title.append(this.axis_choice());
      const names = document.createElement('div');
      names.className = 'names';
      for (const [name, color] of plot.lines) {
        const one = document.createElement('span');
        one.textContent = ` ${name}`;
        one.style.color = colors[color];
        names.append(one, ' ');
      }
      box.append(title, names);
      this.root.append(box);
      const drawn = new uPlot(options(plot, colors, this.size(box)), [this.times, ...this.columns[i]], box);
      return { box, drawn };
    });
  }

  axis_choice() {
    const choice = document.createElement('select');
    choice.className = 'axis';
    choice.setAttribute('aria-label', 'Axis');
    for (const name of ['x', 'y', 'z']) choice.append(new Option(name, name));
    choice.selectedIndex = this.axis;
    choice.addEventListener('change', () => {
      this.axis = choice.selectedIndex;
      const samples = this.samples;
      this.clear();
      for (const frame of samples) this.add(frame);
    });
    return choice;
  }

  size(box) { return { width: Math.max(box.clientWidth - 12, 60), height: Math.max(box.clientHeight - 42, 50) }; }

  resize() { for (const { box, drawn } of this.plots) drawn.setSize(this.size(box)); }

  add(frame) {
    if (frame.seconds < this.next_s - 1) this.clear();     // the master has started anew
    if (frame.seconds < this.next_s) return;
    this.next_s = frame.seconds + SAMPLE_S;
    this.samples.push(frame);
    this.times.push(frame.seconds);
    PLOTS.forEach((plot, i) => plot.lines.forEach((line, k) => {
      const value = line[2](frame, this);
      this.columns[i][k].push(Number.isFinite(value) ? value : null);
    }));
    while (this.times[0] < frame.seconds - SPAN_S) {
      this.times.shift();
      this.samples.shift();
      for (const columns of this.columns) for (const column of columns) column.shift();
    }
  }

  draw(now_ms) {
    if (now_ms - this.drawn_ms < DRAW_MS) return;
    this.drawn_ms = now_ms;
    this.plots.forEach(({ drawn }, i) => drawn.setData([this.times, ...this.columns[i]]));
  }
}
