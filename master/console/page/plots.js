// The live plots of the last half minute, which are drawn several times per second. Commands of the operator are blue,
// reports of the robot are orange, as in the picture.

import Dygraph from 'dygraphs';

const SPAN_S = 30;
const SAMPLE_S = 0.05;
const DRAW_MS = 66;

const last_of = ({ view }, far) => (view.far_known ? far(view.far) : null);
const axis_of = (p, axis) => p?.[axis] ?? null;

/** Plots with name, unit and lines. A line has a name, a colour, and a function of frame and plots that returns its value.
 * `least` is the minimum range of the axis, which starts at zero (`zero`) or is centred on the lines. A line with a fourth
 * entry uses the right axis, which starts at zero; the entry is the minimum range of that axis. */
const PLOTS = [
  { name: 'Position', unit: 'mm', axis: true, least: 2, lines: [
    ['goal', 'operator', (f, s) => 1e3 * axis_of(f.view.goal_m, s.axis)],
    ['measured', 'robot', (f, s) => (last_of(f, (far) => s.anchor && 1e3 * (far.tool.position_m[s.axis] - s.anchor[s.axis])))] ] },
  { name: 'Force', unit: 'N', least: 1, zero: true, lines: [
    ['hand', 'operator', (f) => Math.hypot(...f.view.wrench.force_n)],
    ['tool', 'robot', (f) => last_of(f, (far) => Math.hypot(...far.wrench.force_n))] ] },
  { name: 'Stiffness', unit: 'N/mm', least: 1, zero: true, lines: [
    ['displayed', 'operator', (f) => 1e-3 * f.view.stiffness_n_per_m],
    ['estimated', 'robot', (f) => last_of(f, (far) => (far.estimate.valid ? 1e-3 * far.estimate.stiffness_n_per_m : 0))] ] },
  { name: 'Energy', unit: 'mJ', least: 2, lines: [
    ['net, into the hand', 'operator', (f) => 1e3 * f.view.port_energy_j] ] },
  { name: 'Link', unit: '', least: 1, zero: true, lines: [
    ['round trip, s', 'operator', (f) => (f.link.rtt_known ? f.link.rtt_s : null)],
    ['loss, %', 'contact', (f) => 100 * Math.max(f.link.loss, f.view.far.up_loss), 5] ] },
];

const on_the_right = (line) => line[3] !== undefined;

/** Range of the left or right axis. */
function range(rows, { lines, least, zero }, right) {
  let [low, high] = [Infinity, -Infinity];
  lines.forEach((line, k) => {
    if (on_the_right(line) !== right) return;
    for (const row of rows) {
      if (row[k + 1] === null) continue;
      low = Math.min(low, row[k + 1]);
      high = Math.max(high, row[k + 1]);
    }
  });
  if (right) return [0, 1.1 * Math.max(high, ...lines.filter(on_the_right).map((line) => line[3]))];
  if (zero) return [0, 1.1 * Math.max(high, least)];
  if (low > high) [low, high] = [0, 0];
  const half = 0.55 * Math.max(high - low, least);
  return [(low + high) / 2 - half, (low + high) / 2 + half];
}

/** Options that change with every sample. */
function content(plot, rows) {
  const file = rows.length > 0 ? rows : [[0, ...plot.lines.map(() => null)]];
  const [last] = file.at(-1);
  return { file, dateWindow: [last - SPAN_S, last],
    axes: { y: { valueRange: range(rows, plot, false) }, y2: { valueRange: range(rows, plot, true) } } };
}

/** Labels in seconds before the newest sample. Dygraphs omits a label at the very end of the axis. */
function seconds_ago(from, to) {
  return [0, 1 / 3, 2 / 3, 1 - 1e-9].map((share) => {
    const ago = Math.round((1 - share) * SPAN_S);
    return { v: from + share * (to - from), label: ago > 0 ? `-${ago}` : '0 s' };
  });
}

/** Options that depend only on the colour scheme. */
function options(plot, colors) {
  const axisLabelFormatter = (value) => String(+value.toPrecision(4));
  const y = { axisLabelWidth: 34, axisLabelFormatter, independentTicks: true, pixelsPerLabel: 20 };
  return {
    labels: ['time', ...plot.lines.map((line) => line[0])], colors: plot.lines.map((line) => colors[line[1]]),
    series: Object.fromEntries(plot.lines.filter(on_the_right).map((line) => [line[0], { axis: 'y2' }])),
    strokeWidth: 1.6, pointSize: 0.8, legend: 'never', interactionModel: {},
    axisLabelFontSize: 11, xAxisHeight: 17, axisLineColor: 'transparent', gridLineColor: colors.line, gridLineWidth: 1,
    rightGap: plot.lines.some(on_the_right) ? 0 : 10,
    underlayCallback: (g) => { g.lineJoin = 'round'; },     // mitred lines would show noise as spikes
    axes: { y, y2: { ...y }, x: { axisLabelWidth: 30, axisTickSize: 5, drawGrid: false, ticker: seconds_ago } },
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
    this.rows = PLOTS.map(() => []);
    this.next_s = -Infinity;
    this.drawn_ms = 0;
  }

  paint(colors) {
    for (const drawn of this.plots ?? []) drawn.destroy();
    this.root.replaceChildren();
    this.plots = PLOTS.map((plot) => {
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
      const lines = document.createElement('div');
      lines.className = 'lines';
      box.append(title, names, lines);
      this.root.append(box);
      return new Dygraph(lines, content(plot, []).file, options(plot, colors));
    });
    this.fill();
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

  resize() { for (const drawn of this.plots) drawn.resize(); }

  add(frame) {
    if (frame.seconds < this.next_s - 1) this.clear();     // the master was restarted
    if (frame.seconds < this.next_s) return;
    this.next_s = frame.seconds + SAMPLE_S;
    this.samples.push(frame);
    PLOTS.forEach((plot, i) => {
      const values = plot.lines.map((line) => line[2](frame, this));
      this.rows[i].push([frame.seconds, ...values.map((value) => (Number.isFinite(value) ? value : null))]);
    });
    while (this.samples[0].seconds < frame.seconds - SPAN_S) {
      this.samples.shift();
      for (const rows of this.rows) rows.shift();
    }
  }

  fill() { PLOTS.forEach((plot, i) => this.plots[i].updateOptions(content(plot, this.rows[i]))); }

  draw(now_ms) {
    if (now_ms - this.drawn_ms < DRAW_MS) return;
    this.drawn_ms = now_ms;
    this.fill();
  }
}
