// drive.mjs demo|path|bodies|markers|task|away|open ADDRESS FOLDER PACKAGES CHROMIUM: operates the page and writes screenshots into FOLDER. If
// an expected state is not reached, prints an error; exit status 1.

import { Person, open } from './browser.mjs';

const [what, address, folder, packages, chromium] = process.argv.slice(2);

function require(is_so, sentence) {
  if (!is_so) throw new Error(sentence);
  console.log(`so: ${sentence}`);
}

/** Observes a simulated operator that touches the wall, then takes control. */
async function demo(person) {
  await person.see('engaged', () => longreach.frame().state === 'Engaged');
  await person.look(() => {
    longreach.was = longreach.view();
    // Each plot has an empty canvas on top of the canvas with its lines.
    longreach.ink = () => [...document.querySelectorAll('#plots canvas:first-of-type')].map((canvas) => canvas.toDataURL());
    longreach.plotted = longreach.ink();
  });
  await person.see('the arm moves', () => {
    const [a, b] = [longreach.was.far.joint_rad, longreach.view().far.joint_rad];
    return a.some((q, i) => Math.abs(q - b[i]) > 1e-5);
  });
  await person.see('the plots run', () => longreach.ink().every((url, i) => url !== longreach.plotted[i]));
  await person.see('the ghost', () => longreach.picture()?.arm?.ghost.visible);
  await person.see('the wall is felt', () => longreach.view().in_contact && Math.hypot(...longreach.view().spring_force_n) > 0.3);
  for (const scheme of ['light', 'dark']) {
    await person.scheme(scheme);
    await person.page.setViewport({ width: 1920, height: 1080 });
    await new Promise((done) => { setTimeout(done, 500); });
    await person.shoot(`demo-1920x1080-${scheme}`);
    await person.page.setViewport({ width: 1280, height: 800 });
    await new Promise((done) => { setTimeout(done, 500); });
    await person.shoot(`demo-1280x800-${scheme}`);
  }
  await person.click('#take');
  await person.see('the hand is taken', () => longreach.hand.held && longreach.frame().hand_outside);
  await person.click('[data-mode="rate"]');
  await person.see('rate mode', () => longreach.view().mode === 'RATE');
  await person.click('[data-mode="position"]');
  await person.see('position mode', () => longreach.view().mode === 'POSITION');
  await person.key('-');
  await person.see('another scale', () => Math.abs(longreach.view().scale - 0.75) < 1e-9);
  await person.key('.');
  await person.see('another kv', () => Math.abs(longreach.view().kv_per_s - 2.5) < 1e-9
    && document.getElementById('kv-now').textContent === '2.50');
  await person.click('#kv_down');
  await person.see('the first kv', () => Math.abs(longreach.view().kv_per_s - 2) < 1e-9);
  const note = () => person.look(() => {
    longreach.was = longreach.view();
    longreach.way = (p, q) => Math.hypot(...p.map((x, i) => x - q[i]));
  });
  await note();
  await person.see('the robot follows the hand', () => longreach.way(longreach.view().far.tool.position_m, longreach.was.far.tool.position_m) > 0.004,
    async () => {
      if (await person.hold_on() && await person.look(() => longreach.hand.aim_m[0] > -0.02)) await person.large('s');
    });
  await person.click('#stop');
  await person.see('the robot stops', () => longreach.frame().state === 'Stopped' && longreach.view().far_state === 'STOPPED');
  await new Promise((done) => { setTimeout(done, 1000); });
  await note();
  await person.see('the hand moves on', () => longreach.way(longreach.view().hand_m, longreach.was.hand_m) > 0.008, async () => {
    if (await person.look(() => !longreach.hand.held)) await person.key('t');
    if (await person.look(() => longreach.hand.aim_m[0] < 0.03)) await person.large('w');
  });
  await new Promise((done) => { setTimeout(done, 1500); });
  const moved = await person.look(() => longreach.way(longreach.view().far.tool.position_m, longreach.was.far.tool.position_m));
  require(moved < 5e-4, `the robot does not: ${(1e3 * moved).toFixed(3)} mm`);
}

/** A user operates only the page: approaches the wall over the link, touches it, retreats and stops. */
async function path(person) {
  await person.click('#take');
  await person.see('the hand is taken', () => longreach.hand.held);
  await person.click('#engage');
  await person.see('engaged', () => longreach.frame().state === 'Engaged' && longreach.anchor(), () => person.hold_on());
  // Commanded position of the tool relative to the first anchor.
  await person.look(() => {
    const [first] = longreach.anchor().position_m;
    longreach.commanded = () => longreach.anchor().position_m[0] + longreach.view().goal_m[0] - first;
  });
  // Coarse approach: a deflection of 15 mm commands 20 mm/s. After the release the handle returns home.
  await person.click('[data-mode="rate"]');
  await person.see('rate mode', () => longreach.view().mode === 'RATE', () => person.hold_on());
  await person.grasp();
  await person.see('nearly at the wall', () => longreach.commanded() > 0.09, async () => {
    if (!await person.hold_on()) return;
    // After a hold, rate mode begins where the handle is.
    if (await person.look(() => longreach.view().bring_home)) return person.repeat(' ');
    await person.drag(0.015 - await person.look(() => longreach.hand.aim_m[0]));
  });
  await person.release();
  await person.see('the handle is home', () => Math.abs(longreach.view().hand_m[0]) < 0.004, async () => {
    // If control was taken again after a hold, the handle stays in place until the home key is pressed.
    if (await person.hold_on() && await person.look(() => longreach.hand.aim_m[0] > 0.001)) await person.repeat(' ');
  });
  // Fine approach: the contact is displayed after the delay of the link, and later contacts immediately.
  await person.click('[data-mode="position"]');
  await person.see('position mode', () => longreach.view().mode === 'POSITION', () => person.hold_on());
  await person.grasp();
  await person.see('the robot touches the wall', () => longreach.view().in_contact && longreach.view().stiffness_n_per_m > 500,
    async () => {
      if (await person.hold_on() && await person.look(() => longreach.commanded() < 0.107)) await person.drag(0.001);
    });
  await person.see('the wall is felt', () => Math.hypot(...longreach.view().spring_force_n) > 0.8
    && document.getElementById('felt-x').offsetWidth > 5, async () => {
    if (await person.hold_on() && await person.look(() => longreach.commanded() < 0.115)) await person.drag(0.0005);
  });
  await person.shoot('path-wall');
  await person.drag(-0.02);
  await person.see('let go of the wall', () => !longreach.view().in_contact, async () => {
    if (await person.hold_on() && await person.look(() => longreach.commanded() > 0.095)) await person.drag(-0.001);
  });
  await person.release();
  await person.click('#stop');
  await person.see('the robot stops', () => longreach.view().far_state === 'STOPPED');
  require(person.deeds - person.again < 20,
    `${person.deeds} clicks, drags and keys, under 20 without the ${person.again} for holds of a busy machine`);
}

/** Follows the path of a scene in rate mode until the first ball is passed. */
async function task(person) {
  await person.click('#take');
  await person.see('the hand is taken', () => longreach.hand.held);
  await person.click('#engage');
  await person.see('engaged', () => longreach.frame().state === 'Engaged', () => person.hold_on());
  await person.see('the tool is at the start', () => longreach.task()?.phase === 'READY' && longreach.picture()?.scenery
    && document.getElementById('task').textContent.startsWith('path: the time begins'));
  await person.click('[data-mode="rate"]');
  await person.see('rate mode', () => longreach.view().mode === 'RATE', () => person.hold_on());
  await person.look(() => {
    const start = longreach.view().far.tool.position_m;
    longreach.gone_m = (axis) => longreach.view().far.tool.position_m[axis] - start[axis];
    longreach.red = () => longreach.picture().scenery.balls.map((ball) => ball.material.color.equals(longreach.picture().colors.contact));
  });
  const go = async (key, what, is_there) => {
    for (let i = 0; i < 4; ++i) await person.large(key);
    await person.see(what, is_there, async () => {
      if (!await person.hold_on()) return;
      // After a hold, the handle must have been home.
      if (await person.look(() => longreach.view().bring_home)) return person.repeat(' ');
      if (await person.look(() => Math.hypot(...longreach.hand.aim_m) < 0.015)) await person.large(key);
    });
    await person.key(' ');
  };
  // A tool that continues for too long passes the middle of the turn, too.
  await go('w', 'the end of the first line', () => {
    longreach.early ||= longreach.gone_m(0) < 0.1 && longreach.red().includes(true);
    return longreach.gone_m(0) > 0.115;
  });
  await person.see('the handle is home', () => Math.hypot(...longreach.view().hand_m) < 0.004, () => person.hold_on());
  require(!await person.look(() => longreach.early), 'no ball is red before the first turn');
  await go('a', 'the first ball was passed', () => longreach.task().passed === 1 && longreach.gone_m(1) > 0.03);
  await person.see('it is red', () => longreach.red().join() === 'true,false,false');
  const { drawn, text, time_s } = await person.look(() => ({ drawn: longreach.picture().trails.task.count,
    text: document.getElementById('task').textContent, time_s: longreach.task().time_s }));
  require(drawn > 20 && drawn < 400, `the trajectory has ${drawn} points`);
  require(text.includes('ball 1 of 3') && time_s > 3, `the page says: ${text}`);
  await person.shoot('task');
  await person.click('#stop');
  await person.see('the robot stops', () => longreach.view().far_state === 'STOPPED');
}

/** A user grips a free body, drags it and releases it in motion. A held body moves with the tool. */
async function bodies(person) {
  await person.click('#take');
  await person.see('the hand is taken', () => longreach.hand.held);
  await person.click('#engage');
  await person.see('engaged', () => longreach.frame().state === 'Engaged', () => person.hold_on());
  await person.see('the body is reported', () => longreach.view().bodies.body1
    && document.getElementById('bodies-key').textContent.startsWith('free bodies, '));
  // Measured with the frame of each picture: from the tool to the drawn body, and the path of the drawn body.
  await person.look(() => {
    const picture = longreach.picture();
    const show = picture.show.bind(picture);
    picture.show = (frame, ...more) => {
      show(frame, ...more);
      const drawn = picture.bodies.tracked[0].group.position.clone().add(picture.bodies.group.position).toArray();
      longreach.drawn = drawn;
      longreach.from_tool = drawn.map((x, i) => x - frame.view.far.tool.position_m[i]);
      longreach.distance = (p, q) => Math.hypot(...p.map((x, i) => x - q[i]));
      if (longreach.rest) {
        longreach.off_m = Math.max(longreach.off_m ?? 0, longreach.distance(longreach.from_tool, longreach.rest.from_tool));
        longreach.moved_m = Math.max(longreach.moved_m ?? 0, longreach.distance(drawn, longreach.rest.drawn));
      }
    };
  });
  await person.key('g');
  await person.see('the gripper holds the body', () => longreach.view().far.load, () => person.hold_on());
  await new Promise((done) => { setTimeout(done, 1000); });
  await person.look(() => { longreach.rest = { drawn: longreach.drawn, from_tool: longreach.from_tool }; });
  await person.grasp();
  await person.see('the body was dragged by 20 mm', () => longreach.moved_m > 0.02, async () => {
    if (await person.hold_on() && await person.look(() => longreach.hand.aim_m[0] > -0.04)) await person.drag(-0.001);
  });
  await person.shoot('bodies-held');
  const { off_m, moved_m, opaque } = await person.look(() => ({ off_m: longreach.off_m, moved_m: longreach.moved_m,
    opaque: longreach.picture().bodies.tracked[0].material.opacity }));
  require(off_m < 0.005, `the held body is drawn within ${(1e3 * off_m).toFixed(2)} mm of the tool, dragged by ${(1e3 * moved_m).toFixed(0)} mm`);
  require(opaque === 1, 'a reported body is opaque');
  const goal = await person.look(() => longreach.picture().bodies.goal.position.toArray());
  require(goal.join() === '-0.1,0.2,0.05', `the goal of the body is drawn at ${goal}`);
  await person.release();
  await person.key('g');
  await person.see('the gripper has released it', () => !longreach.view().far.load, () => person.hold_on());
  await person.look(() => { longreach.was = longreach.view().far.tool.position_m; });
  await person.grasp();
  await person.see('the tool moves on without the body', () => longreach.distance(longreach.from_tool, longreach.rest.from_tool) > 0.015, async () => {
    if (await person.hold_on() && await person.look(() => longreach.hand.aim_m[0] > -0.07)) await person.drag(-0.001);
  });
  await person.shoot('bodies-released');
  await person.release();
  await person.click('#stop');
  await person.see('the robot stops', () => longreach.view().far_state === 'STOPPED');
}

/** The master ends and is restarted. */
async function away(person) {
  await person.see('observing', () => longreach.frame().state === 'Observing');
  await person.see('no master', () => document.getElementById('state').textContent === 'no master');
  await new Promise((done) => { setTimeout(done, 500); });
  const words = await person.look(() => document.getElementById('banner').innerText);
  require(words.includes('master does not respond'), `the banner says why: ${words.replaceAll('\n', ' ')}`);
  await person.look(() => { longreach.before = longreach.feed.frames; });
  await person.see('observing again', () => document.getElementById('state').textContent === 'Observing');
  await person.see('frames again', () => longreach.feed.frames > longreach.before + 30);
}

/** A body that a robot tracks and no scene describes is drawn as a marker at its pose. */
async function markers(person) {
  await person.see('the body is reported', () => longreach.view().bodies.body1
    && document.getElementById('bodies-key').textContent.startsWith('free bodies, '));
  await person.see('its marker is drawn', () => longreach.picture()?.bodies.markers[1]?.group.visible);
  const off_m = await person.look(() => {
    const { bodies } = longreach.picture();
    const drawn = bodies.markers[1].group.position.clone().add(bodies.group.position).toArray();
    return Math.hypot(...drawn.map((x, i) => x - longreach.view().bodies.body1.pose.position_m[i]));
  });
  require(off_m < 0.005, `it is drawn ${(1e3 * off_m).toFixed(2)} mm from its reported position`);
  require(await person.look(() => !longreach.picture().bodies.markers[2]), 'no other body has a marker');
  await person.shoot('markers');
}

/** Only opens the page and receives frames. */
async function opened(person) {
  await person.see('observing', () => longreach.frame().state === 'Observing');
}

const browser = await open(packages, chromium);
const person = new Person(await browser.newPage(), folder);
try {
  await person.visit(address);
  const { bytes, loaded_ms } = await person.look(() => {
    const [page] = performance.getEntriesByType('navigation');
    const parts = [page, ...performance.getEntriesByType('resource')];
    return { bytes: parts.reduce((sum, part) => sum + part.decodedBodySize, 0), loaded_ms: page.loadEventEnd };
  });
  require(bytes < 1.5e6, `the page has ${(1e-6 * bytes).toFixed(2)} MB, under 1.5; loaded in ${(1e-3 * loaded_ms).toFixed(2)} s`);
  await { demo, path, bodies, markers, task, away, open: opened }[what](person);
  require(person.errors.length === 0, `the console is free of errors: ${person.errors.join('; ') || 'it is empty'}`);
} catch (error) {
  console.error(`drive: ${error.message}`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
