// The panel: brings the robot's news to what shows them, and what a person does to the robot.
import { Bar } from "./bar.js";
import { Chords } from "./chords.js";
import { CraneLowering } from "./crane.js";
import { DamageSheet } from "./damage.js";
import { Dds } from "./dds.js";
import { byId, focusWants, number, setText } from "./dom.js";
import { DragTool } from "./drag.js";
import { Events } from "./events.js";
import { Eyes } from "./eyes.js";
import { Faults } from "./faults.js";
import { makeHelp } from "./help.js";
import { Joints } from "./joints.js";
import { Link, takeToken } from "./link.js";
import { MotorTable } from "./motor_table.js";
import { snapshotOf } from "./playback.js";
import { Plots } from "./plots.js";
import { Recordings } from "./recordings.js";
import { Remote } from "./remote.js";
import { Rig } from "./rig.js";
import { saveCsv, savePicture, savePlots } from "./save.js";
import { SensorTable } from "./sensor_table.js";
import { Services } from "./services.js";
import { Settings } from "./settings.js";
import { Sight } from "./sight.js";
import { rollPitchYaw, shortName, signalsOf } from "./signals.js";
import { Splitters } from "./splitters.js";
import { recall, remember, setRobot } from "./store.js";
import { makeTabs } from "./tabs.js";
import { showTips } from "./tips.js";
import { TouchSheet } from "./touch.js";
import { TruthSheet } from "./truth.js";
import { View } from "./view.js";

const TABLE_EVERY = 100; // ms: nobody reads faster
const HIDDEN_HZ = 5; // snapshots a second while the page is out of sight: histories go on

const STALE = "Another run has this address now and does not know this page's token, so you can only look. " +
  "Open the new URL, which the robot printed at its start and `understudy ctl panel` prints.";
const REPLAYS = "A recording is shown. This acts on the live robot: choose \"Back to live\" first.";
const NO_TOKEN = "You can only look: this address has no token. To control the robot, open the URL that " +
  "the robot printed at its start and `understudy ctl panel` prints.";

// What of the view can be switched on and off, and stays so.
const TOGGLES = [
  ["follow", (on) => (view.following = on)],
  ["contacts", (on) => (view.contacts.visible = on)],
  ["com", (on) => (view.com.visible = on)],
  ["collisions", (on) => view.showCollisions(on)],
  ["trail", (on) => (view.trail.visible = on)],
  ["cloud", (on) => sight.choose("cloud", on)],
  ["heights", (on) => sight.choose("heights", on)],
];

const dark = window.matchMedia("(prefers-color-scheme: dark)");
const view = makeView();
let scene = null;
let signalsKnown = false;
let tableShown = 0;
let replaying = false; // all that is shown is a recording's
let liveSnapshot = null; // the newest of the robot

const link = new Link(takeToken(), { scene: setScene, snapshot: showSnapshot, status: showStatus,
                                     event: showEvent,
                                     line: showLine, token: showToken,
                                     robots: (robots) => bar.setRobots(robots) });

function makeView() {
  try {
    return new View(byId("canvas"));
  } catch (error) {
    setText(byId("lost"), `This page needs WebGL, and the browser has none (${error.message}).`);
    byId("lost").hidden = false;
    throw error;
  }
}

// A request, and in plain words why the robot did not take it, "" if it did.
async function request(name, values) {
  const answer = await link.request(name, values);
  if (answer.status === 200) return "";
  if (answer.status === 401 || answer.status === 403) showToken("stale");
  const why = answer.error ?? `${name}: ${answer.status}`;
  say(why);
  return why;
}

const bar = new Bar(request);
const rig = new Rig(request);
const lowering = new CraneLowering(request);
const splitters = new Splitters(() => plots.resize());
const speed = () => bar.speed;
const remote = new Remote(request, speed);
const chords = new Chords(request, speed);
const joints = new Joints((name, values) => link.request(name, values), speed, say);
const settings = new Settings(link, request);
const faults = new Faults(link, request, () => {
  byId("tab-rig").click();
  byId("faults").scrollIntoView({ block: "nearest" });
});
const events = new Events();
const services = new Services(request);
const recordings = new Recordings(link, showRecorded, say);
new Dds(link);
const table = new MotorTable(plotMotor);
const eyes = new Eyes(link, say);
const sight = new Sight(link, view, say);
new DamageSheet(link);
const truth = new TruthSheet(link);
const touch = new TouchSheet(link);
const sensors = new SensorTable((names) => plots.showFirst(names));
const plots = new Plots({ list: byId("plot-list"), hold: byId("plots-hold"),
                          options: byId("signals"), seconds: byId("plots-seconds"),
                          add: byId("plots-add") });
const takesRequests = () => !replaying && !document.body.classList.contains("looking");
const pushing = () => byId("push-tool").getAttribute("aria-pressed") === "true";
new DragTool(view, request, (event) => takesRequests() && (event.ctrlKey || pushing()), speed);

// Some requests go many times a second: one complaint is enough.
function say(text) {
  const again = !byId("message").hidden && byId("message").textContent === text;
  if (!again) events.add(text, "bad", view.snapshot?.time);
  setText(byId("message"), text);
  byId("message").hidden = false;
  clearTimeout(say.timer);
  say.timer = setTimeout(() => (byId("message").hidden = true), 6000);
}

async function setScene(description) {
  scene = description;
  signalsKnown = false;
  bar.setScene(scene);
  setRobot(scene.robot);
  splitters.restore();
  chords.setScene(scene);
  lowering.setScene(scene);
  truth.setScene(scene);
  touch.setScene(scene);
  services.setServices((await link.json("/services")).services);
  rig.setScene(scene, (await link.json("/requests")).requests);
  table.setMotors(scene.motors);
  joints.setMotors(scene.motors);
  settings.read();
  await faults.read();
  const bare = await view.setScene(scene, (path) => link.bytes(path));
  byId("collisions").setAttribute("aria-pressed", bare);
  await sight.setScene(scene);
  for (const [id, apply] of TOGGLES) {
    const kept = recall(`view.${id}`);
    if (typeof kept === "boolean" && !(id === "collisions" && bare)) press(id, apply, kept);
  }
}

function showSnapshot(snapshot) {
  if (!signalsKnown) {
    signalsKnown = true;
    plots.setSignals(signalsOf(scene, snapshot), standardPlots());
    sensors.setSensors(scene, snapshot);
  }
  liveSnapshot = snapshot;
  plots.push(snapshot);
  if (replaying) return;
  view.show(snapshot);
  if (!tablesAreDue()) return;
  bar.showSnapshot(snapshot);
  bar.showBattery(snapshot.battery);
  remote.show(snapshot.remote);
  joints.show(snapshot);
  faults.show(snapshot);
  showTables(snapshot, snapshot.imus[0].quaternion);
}

function tablesAreDue() {
  const now = performance.now();
  if (now - tableShown < TABLE_EVERY) return false;
  tableShown = now;
  return true;
}

function showTables(snapshot, attitude) {
  table.show(snapshot);
  sensors.show(snapshot);
  showReadings(snapshot, attitude);
}

// An instant of a recording in place of the robot, in all that is shown; null: the robot again.
function showRecorded(instant) {
  if (!liveSnapshot) return;
  const replays = instant !== null;
  if (replays !== replaying) {
    replaying = replays;
    plots.replay(replays);
    bar.showRecorded(replays ? { time: instant.time, name: recordings.playing.name } : null);
    allowControls();
    if (replays) eyes.choose(""); // they are the live robot's
    sight.pause(replays);
    tableShown = 0;
  }
  if (!replays) return showSnapshot(liveSnapshot);
  const recorded = snapshotOf(scene, liveSnapshot.imus.length, instant);
  view.show(recorded);
  plots.push(recorded);
  bar.showRecorded({ time: instant.time, name: recordings.playing.name });
  if (tablesAreDue()) showTables(recorded, recorded.bodies[scene.base].slice(3));
}

function standardPlots() {
  const torques = scene.motors.slice(0, 3).map((motor) => `${shortName(motor)} torque`);
  return [torques, ["imu roll", "imu pitch"]];
}

function plotMotor(index) {
  const name = shortName(scene.motors[index]);
  plots.showFirst([`${name} position`, `${name} commanded position`]);
}

// `attitude`: w x y z.
function showReadings(snapshot, attitude) {
  const [roll, pitch, yaw] = rollPitchYaw(attitude).map((a) => number(a, 3));
  setText(byId("attitude"), `${roll} ${pitch} ${yaw} rad`);
  const [x, y, z] = snapshot.bodies[scene.base].map((value) => number(value, 2));
  setText(byId("place"), `${x} ${y} ${z} m`);
  const weight = snapshot.contacts.reduce((sum, { force }) => sum + Math.abs(force[2]), 0);
  const count = `${snapshot.contacts.length} ${snapshot.contacts.length === 1 ? "contact" : "contacts"}`;
  setText(byId("ground"), snapshot.recorded ? "– N" : `${count}, ${number(weight, 0)} N`);
  const pull = snapshot.pushes.map(({ force }) => Math.hypot(...force)).reduce((a, b) => a + b, 0);
  setText(byId("pull"), pull > 0 ? `push ${number(pull, 0)} N` : "");
}

function showEvent(event) {
  if (event.kind === "setting") settings.read();
  events.show(event);
  chords.showEvent(event);
  services.show(event);
}

function showStatus(status) {
  if (!replaying) bar.showStatus(status);
  if (!replaying) sensors.showHands(status.hand_force);
  chords.showStatus(status);
  rig.show(status);
  lowering.show(status);
  joints.showStatus(status);
  events.showStatus(status);
}

function showLine(state, why) {
  if (!replaying) bar.showLine(state, why);
  const text = { lost: `Connection lost (${why}). Trying again …`,
                 silent: "The robot does not answer. Has its process been stopped?" }[state];
  setText(byId("lost"), text ?? "");
  byId("lost").hidden = !text;
  document.body.classList.toggle("away", state === "lost");
}

function showToken(state) {
  const looking = state !== "ok";
  document.body.classList.toggle("looking", looking);
  allowControls();
  setText(byId("token"), { stale: STALE, none: NO_TOKEN }[state] ?? "");
  byId("token").hidden = !looking;
  byId("recordings-read").disabled = looking;
  listRecordings();
}

// What acts on the robot needs the token, and the robot in sight; to damp it needs no sight.
function allowControls() {
  remote.setEnabled(takesRequests());
  const looking = document.body.classList.contains("looking");
  for (const controls of document.querySelectorAll(".requests")) {
    const always = controls.contains(byId("damp"));
    controls.disabled = looking || (replaying && !always);
    controls.title = replaying && !always ? REPLAYS : "";
  }
  for (const part of document.querySelectorAll(".live-only")) part.inert = replaying;
}

function press(id, apply, on) {
  byId(id).setAttribute("aria-pressed", on);
  apply(on);
  view.invalidate();
}

function listRecordings() {
  const looking = document.body.classList.contains("looking");
  if (document.body.dataset.tab === "recordings" && !looking) recordings.list();
}

function toggle(id, apply, then = () => {}) {
  byId(id).addEventListener("click", () => {
    const on = byId(id).getAttribute("aria-pressed") !== "true";
    press(id, apply, on);
    then(on);
  });
}

for (const [id, apply] of TOGGLES) toggle(id, apply, (on) => remember(`view.${id}`, on));
toggle("push-tool", (on) => view.canvas.classList.toggle("pushing", on));
byId("home").addEventListener("click", () => view.home());
byId("camera").addEventListener("change", () => {
  view.lookFrom(byId("camera").value);
  byId("camera").value = "";
});
byId("picture").addEventListener("click", () => savePicture(view));
byId("plots-png").addEventListener("click", () => savePlots(plots));
byId("plots-csv").addEventListener("click", () => saveCsv(plots));
showTips(byId("tip"));
makeHelp();
byId("bar-more").addEventListener("click", () => {
  const open = document.body.classList.toggle("bar-open");
  byId("bar-more").setAttribute("aria-expanded", open);
});

window.addEventListener("keydown", (event) => {
  if (event.key !== " " || focusWants(event) || !(replaying || takesRequests())) return;
  event.preventDefault();
  if (!event.repeat) byId(replaying ? "recording-run" : "pause").click();
});
// A list from which the pointer has chosen gives the keys back, to the remote controller.
for (const list of document.querySelectorAll("select")) {
  let pointed = false;
  list.addEventListener("pointerdown", () => (pointed = true));
  list.addEventListener("keydown", () => (pointed = false));
  list.addEventListener("change", () => pointed && list.blur());
}
const setRate = () => link.setRate(document.hidden ? HIDDEN_HZ : 60);
document.addEventListener("visibilitychange", setRate);
setRate();
// The URL of another run, opened in this tab, changes nothing but what is behind the #.
window.addEventListener("hashchange", () => location.reload());

function applyTheme() {
  view.setTheme(dark.matches);
  plots.setTheme(dark.matches ? "#2b323a" : "#dfe3e7");
}
dark.addEventListener("change", applyTheme);
applyTheme();
makeTabs(byId("tabs"), () => {
  plots.resize();
  listRecordings();
});
new ResizeObserver(() => plots.resize()).observe(byId("plot-list"));
showToken(link.token ? "ok" : "none");
link.run();

// For tests and for the curious at the browser's console.
window.panel = { view, link, plots, sight, touch };
