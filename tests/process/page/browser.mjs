// A headless browser with the page of `longreach view`, which is operated with mouse and keys and checked for errors.

import { createRequire } from 'module';
import { join } from 'path';

/** `packages`: folder into which the build installed the packages of the tests. */
export async function open(packages, chromium) {
  const puppeteer = createRequire(join(packages, 'package.json'))('puppeteer-core');
  return puppeteer.launch({
    executablePath: chromium,
    headless: true,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage'],
  });
}

export class Person {
  constructor(page, folder) {
    this.page = page;
    this.folder = folder;
    this.errors = [];
    this.deeds = 0;     // clicks and keys
    this.again = 0;     // repetitions that a busy machine made necessary
    this.engaged_ms = 0;
    page.on('console', (message) => { if (message.type() === 'error') this.errors.push(message.text()); });
    page.on('pageerror', (error) => this.errors.push(String(error)));
    page.on('requestfailed', (request) => this.errors.push(`not loaded: ${request.url()}`));
  }

  async visit(address) {
    await this.page.setViewport({ width: 1280, height: 800 });
    await this.page.goto(address, { waitUntil: 'load' });
    await this.see('the first frames', () => longreach.feed.frames > 30 && longreach.view().far_known);
  }

  async click(selector) {
    this.deeds += 1;
    await this.page.click(selector);
  }

  async key(name) {
    this.deeds += 1;
    await this.page.keyboard.press(name);
  }

  async repeat(name) {
    this.again += 1;
    await this.key(name);
  }

  /** Presses a key with shift: a large step. */
  async large(name) {
    this.deeds += 1;
    await this.page.keyboard.down('Shift');
    await this.page.keyboard.press(name);
    await this.page.keyboard.up('Shift');
  }

  /** Grasps the handle on the pad; drag() and release() follow. */
  async grasp() {
    this.deeds += 1;
    this.grasps = true;
    const pad = await (await this.page.$('#pad')).boundingBox();
    this.at = { x: pad.x + pad.width / 2, y: pad.y + pad.height / 2 };
    this.px_per_m = await this.page.evaluate(() => (0.45 * document.getElementById('pad').clientHeight) / longreach.frame().workspace_m);
    await this.page.mouse.move(this.at.x, this.at.y);
    await this.page.mouse.down();
  }

  /** Drags forwards, along x. */
  async drag(by_m) {
    this.at.y -= by_m * this.px_per_m;
    await this.page.mouse.move(this.at.x, this.at.y, { steps: 6 });
  }

  async release() {
    this.grasps = false;
    await this.page.mouse.up();
  }

  /** Waits until `is_so` returns true and calls `meanwhile` repeatedly. */
  async see(what, is_so, meanwhile = async () => {}) {
    const end = Date.now() + 150000;
    while (!await this.look(is_so)) {
      if (Date.now() > end) {
        await this.shoot('missed');
        throw new Error(`never seen: ${what}; the last frame was ${await this.look(() => JSON.stringify(longreach.frame()))}`);
      }
      await meanwhile();
      await new Promise((done) => { setTimeout(done, 100); });
    }
    console.log(`seen: ${what}`);
  }

  /** A busy machine can suspend the page for longer than the timeout of the hand, which causes a hold. Recovers from it. */
  async hold_on() {
    const { held, state } = await this.look(() => ({ held: longreach.hand.held, state: longreach.frame().state }));
    const afresh = async (key) => {
      const grasps = this.grasps;
      if (grasps) await this.release();
      await this.repeat(key);
      if (!grasps) return;
      this.again += 1;
      await this.grasp();     // in the middle of the pad, because further drags would leave the window
    };
    if (!held) {
      await afresh('t');
    } else if (state === 'Holding' && Date.now() - this.engaged_ms > 8000) {     // the response takes a round trip
      console.log('held meanwhile: engaged again');
      this.engaged_ms = Date.now();
      await afresh('e');     // the deflection of the hand counts from where it is at the engagement
    }
    return held && state === 'Engaged';
  }

  async look(picture) { return this.page.evaluate(picture); }

  async scheme(name) {
    await this.page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: name }]);
  }

  async shoot(name) { await this.page.screenshot({ path: join(this.folder, `${name}.png`) }); }
}
