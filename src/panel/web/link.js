// The line to the robot: what it is, its snapshots, status and events as they come, requests to it.
const RETRIES = [500, 1000, 2000, 4000]; // ms between attempts to reach it
const STATUS_EVERY = 250; // ms
const SILENCE = 2000; // ms without a snapshot after which one says so
const PARTS = "bodies,contacts,com,crane,pushes,motors,imus,battery,feet,remote,command,faults";
const PATIENCE = 5000; // ms; the robot itself answers within 2 s
const LAPSE = 0.5; // s of wall time after which the robot lets go of what is not renewed
const LONGEST = 60; // s of simulated time, what a drag may last

// LAPSE in simulated seconds, as requests have it; `speed` 0 is unbounded, and taken for 20.
export function lapse(speed) {
  return Math.min(LAPSE * Math.max(speed || 20, 0.1), LONGEST);
}

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// The token of the URL (#token=...), kept for reloads of this tab and taken out of the address.
export function takeToken() {
  const found = /(?:^#|&)token=([0-9A-Za-z]+)/.exec(location.hash);
  if (found) {
    sessionStorage.setItem("token", found[1]);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem("token") ?? "";
}

export class Link {
  // `on` has a function for each kind of news: scene(description), snapshot(snapshot),
  // status(status), event(event), line(state, why) with state live | silent | lost, token(state), robots([{name, url}])
  // with state ok | none | stale.
  constructor(token, on) {
    this.token = token;
    this.on = on;
    this.known = null; // the newest status
    this.described = false;
    this.requestsOpen = false; // the robot knows the token
    this.hz = 60;
    this.snapshots = null;
    this.requests = null;
    this.waiting = new Map(); // id of a request -> what its answer goes to
    this.next = 1;
  }

  async get(path) {
    const reply = await fetch(path, { cache: "no-store" });
    if (!reply.ok) throw new Error(`${path}: ${reply.status} ${reply.statusText}`);
    return reply;
  }

  json(path) {
    return this.get(path).then((reply) => reply.json());
  }

  bytes(path) {
    return this.get(path).then((reply) => reply.arrayBuffer());
  }

  // Stays connected for as long as the page lives.
  async run() {
    for (let failures = 0; ; ) {
      let why = "the robot closed the connection";
      try {
        await this.readStatus();
        await this.checkToken();
        if (!this.described) await this.on.scene(await this.json("/scene"));
        this.described = true; // another robot would be another process
        failures = 0;
        await this.follow();
      } catch (error) {
        why = error.message;
      }
      this.dropRequests(why);
      this.on.line("lost", why);
      await pause(RETRIES[Math.min(failures++, RETRIES.length - 1)]);
    }
  }

  // Another run on the same port: the page begins anew, with its scene and without this token. In a
  // container the next process may have the number of the one before.
  async readStatus() {
    const { known } = this;
    const now = await this.json("/status");
    const same = !known ||
      (now.pid === known.pid && now.robot === known.robot && now.time >= known.time);
    if (!same) {
      location.reload();
      await new Promise(() => {}); // the page goes
    }
    this.known = now;
    this.on.status(now);
  }

  // Passes snapshots and status on until the line breaks.
  async follow() {
    this.openRequests();
    const events = new WebSocket(this.socketUrl("/events"));
    events.onmessage = ({ data }) => this.on.event(JSON.parse(data));
    let live = true;
    const watch = async () => {
      while (live) {
        await pause(STATUS_EVERY);
        if (!live || document.hidden) continue;
        try {
          await this.readStatus();
        } catch {
          // The snapshots' end says it.
        }
      }
    };
    watch();
    try {
      // Each turn is one socket; a page that goes out of sight asks for fewer snapshots by another.
      while (await this.stream());
    } finally {
      live = false;
      events.close();
    }
  }

  // Resolves true when the socket was closed to be opened anew at another rate.
  stream() {
    return new Promise((done) => {
      const socket = new WebSocket(this.socketUrl(`/snapshots?hz=${this.hz}&parts=${PARTS}`));
      this.snapshots = socket;
      socket.again = false;
      let heard = performance.now();
      const watch = setInterval(() => {
        const silent = performance.now() - heard > SILENCE;
        if (silent && !document.hidden) this.on.line("silent", "nothing received for 2 s");
      }, SILENCE / 4);
      socket.onmessage = ({ data }) => {
        heard = performance.now();
        this.on.line("live");
        this.on.snapshot(JSON.parse(data));
      };
      socket.onclose = () => {
        clearInterval(watch);
        done(socket.again);
      };
    });
  }

  setRate(hz) {
    if (hz === this.hz) return;
    this.hz = hz;
    if (!this.snapshots) return;
    this.snapshots.again = true;
    this.snapshots.close();
  }

  socketUrl(path) {
    return `ws://${location.host}${path}`;
  }

  // ---- requests

  // Whether the robot takes requests from this page, by what needs the token and changes nothing.
  async checkToken() {
    if (!this.token) return this.on.token("none");
    const reply = await fetch("/panel", { headers: this.authorization(), cache: "no-store" });
    this.requestsOpen = reply.status !== 401 && reply.status !== 403;
    this.on.token(this.requestsOpen ? "ok" : "stale");
    if (reply.ok) this.on.robots((await reply.json()).robots);
  }

  authorization() {
    return { Authorization: `Bearer ${this.token}` };
  }

  openRequests() {
    if (!this.token || !this.requestsOpen) return;
    const socket = new WebSocket(this.socketUrl(`/requests?token=${this.token}`));
    socket.onmessage = ({ data }) => {
      const answer = JSON.parse(data);
      this.waiting.get(answer.id)?.(answer);
      this.waiting.delete(answer.id);
    };
    socket.onclose = () => {
      if (this.requests === socket) this.dropRequests("the connection broke");
    };
    this.requests = socket;
  }

  dropRequests(why) {
    const socket = this.requests;
    this.requests = null;
    socket?.close();
    for (const answer of this.waiting.values()) answer({ status: 0, error: why });
    this.waiting.clear();
  }

  // Promise of {status, error?}: 200 when done. In the order of the calls. Never rejects.
  request(name, values = {}) {
    if (this.requests?.readyState !== WebSocket.OPEN) return this.post(name, values);
    const id = this.next++;
    return new Promise((done) => {
      const late = setTimeout(() => {
        if (this.waiting.delete(id)) done({ status: 0, error: "no answer within 5 s" });
      }, PATIENCE);
      this.waiting.set(id, (answer) => {
        clearTimeout(late);
        done(answer);
      });
      this.requests.send(JSON.stringify({ [name]: values, id }));
    });
  }

  async post(name, values = {}) {
    try {
      const reply = await fetch(`/${name.replace(".", "/")}`, {
        method: "POST",
        headers: { ...this.authorization(), "Content-Type": "application/json" },
        body: JSON.stringify(values),
      });
      const { error } = await reply.json();
      return { status: reply.status, error };
    } catch (error) {
      return { status: 0, error: error.message };
    }
  }
}
