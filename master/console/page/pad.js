// The handle from above: its workspace, its position, the target of the hand, the force on it, and the remembered wall.
// Up is x and left is y, as with the keys. The narrow canvas next to it shows z.

const MARGIN = 0.9;     // fraction of the half width that shows the workspace
const FORCE_PX_PER_N = 14;

function prepared(canvas) {
  const ratio = Math.min(window.devicePixelRatio, 2);
  const { clientWidth: w, clientHeight: h } = canvas;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  const g = canvas.getContext('2d');
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  return { g, w, h };
}

export const pad_radius = (canvas) => (MARGIN * Math.min(canvas.clientWidth, canvas.clientHeight)) / 2;

function disc(g, x, y, radius, fill, stroke) {
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  if (fill) {
    g.fillStyle = fill;
    g.fill();
  }
  if (stroke) {
    g.strokeStyle = stroke;
    g.stroke();
  }
}

function segment(g, x0, y0, x1, y1, color, width) {
  g.strokeStyle = color;
  g.lineWidth = width;
  g.beginPath();
  g.moveTo(x0, y0);
  g.lineTo(x1, y1);
  g.stroke();
  g.lineWidth = 1;
}

/** The half of the disc behind the remembered surface: n . p > s. */
function wall(g, x, y, radius, n, s, scale, color) {
  const across = Math.hypot(n[0], n[1]);
  if (across < 0.3) return;     // from above, the surface is not a line
  const angle = Math.atan2(-n[0], -n[1]);
  g.save();
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  g.clip();
  g.translate(x, y);
  g.rotate(angle);
  g.globalAlpha = 0.22;
  g.fillStyle = color;
  const from = (s / across) * scale;
  g.fillRect(from, -radius, 2 * radius, 2 * radius);
  g.globalAlpha = 1;
  g.fillRect(from, -radius, 1.5, 2 * radius);
  g.restore();
}

export function draw_pad(canvas, { workspace_m, view }, hand, colors) {
  const { g, w, h } = prepared(canvas);
  const [x, y] = [w / 2, h / 2];
  const radius = pad_radius(canvas);
  const scale = radius / workspace_m;
  disc(g, x, y, radius, colors.ground, colors.line);
  if (view.surface_known) wall(g, x, y, radius, view.inward, view.surface_m, scale, colors.contact);
  segment(g, x - radius, y, x + radius, y, colors.line, 1);
  segment(g, x, y - radius, x, y + radius, colors.line, 1);
  const at = (p) => [x - p[1] * scale, y - p[0] * scale];
  const [hx, hy] = at(view.hand_m);
  const force = view.wrench.force_n;
  segment(g, hx, hy, hx - force[1] * FORCE_PX_PER_N, hy - force[0] * FORCE_PX_PER_N, colors.contact, 3);
  if (hand.held) disc(g, ...at(hand.aim_m), 12, null, colors.operator);
  disc(g, hx, hy, 8, hand.held ? colors.operator : colors.quiet, colors.card);
  g.fillStyle = colors.quiet;
  g.font = '11px system-ui, sans-serif';
  g.fillText('+x', x + 5, y - radius + 12);
  g.fillText('+y', x - radius + 4, y - 5);
}

export function draw_lift(canvas, { workspace_m, view }, hand, colors) {
  const { g, w, h } = prepared(canvas);
  const half = MARGIN * h / 2;
  const scale = half / workspace_m;
  segment(g, w / 2, h / 2 - half, w / 2, h / 2 + half, colors.line, 2);
  segment(g, w / 2 - 8, h / 2, w / 2 + 8, h / 2, colors.line, 1);
  const y = h / 2 - view.hand_m[2] * scale;
  segment(g, w / 2, y, w / 2, y - view.wrench.force_n[2] * FORCE_PX_PER_N, colors.contact, 3);
  if (hand.held) disc(g, w / 2, h / 2 - hand.aim_m[2] * scale, 11, null, colors.operator);
  disc(g, w / 2, y, 7, hand.held ? colors.operator : colors.quiet, colors.card);
  g.fillStyle = colors.quiet;
  g.font = '11px system-ui, sans-serif';
  g.fillText('+z', 3, 12);
}
