// The WebSocket to the view server. It passes received messages to `talk`, and send() sends requests of the page. It
// reconnects automatically.

const RETRY_MS = 1000;
const SILENT = 'the view server does not respond; retrying every second';
const ANOTHER = 'the view server was restarted; open the address that it printed';

/** Vectors and joint positions of a message become arrays. */
function as_array(_, value) {
  const numbers = value === null || typeof value !== 'object' ? [] : Object.keys(value).join();
  return /^(x,y,z|joint1(,joint\d)*)$/.test(numbers) ? Object.values(value) : value;
}

export class Feed {
  /** `talk`: functions by the name of the message: frame, scene, anchor, desk, said, links, down, slave_down, full; and
   * `lost`, which is called when the server does not respond. */
  constructor(talk) {
    this.talk = talk;
    this.frames = 0;
    this.gap_max_ms = 0;
    this.last_ms = null;
    this.times_ms = [];
    this.connect();
  }

  connect() {
    const address = new URL('live', location.href);
    address.protocol = 'ws:';
    this.socket = new WebSocket(address);
    this.socket.onmessage = (event) => this.take(JSON.parse(event.data, as_array));
    this.socket.onclose = () => {
      this.last_ms = null;
      this.talk.lost(this.stranger ? ANOTHER : SILENT);
      this.ask_why();
      setTimeout(() => this.connect(), RETRY_MS);
    };
  }

  /** A restarted server has a different token, so further attempts are useless. */
  async ask_why() {
    try {
      this.stranger = (await fetch(location.href, { method: 'GET', cache: 'no-store' })).status === 403;
    } catch {
      this.stranger = false;
    }
  }

  take(message) {
    if (message.frame) this.count();
    if (message.robot) return this.talk.scene(message);
    for (const name of Object.keys(message)) {
      if (name === 'refused') continue;
      this.talk[name]?.(message[name], message);
    }
  }

  count() {
    const now = performance.now();
    if (this.last_ms !== null) this.gap_max_ms = Math.max(this.gap_max_ms, now - this.last_ms);
    this.last_ms = now;
    this.frames += 1;
    this.times_ms.push(now);
    if (this.times_ms.length > 120) this.times_ms.shift();
  }

  /** Frames per second, averaged over the last two seconds. */
  rate_hz() {
    const n = this.times_ms.length;
    return n > 1 ? (1e3 * (n - 1)) / (this.times_ms[n - 1] - this.times_ms[0]) : 0;
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
