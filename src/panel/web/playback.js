// An instant of a recording as the page shows it: what a recording has, and blanks for what it has not.
const NONE = [NaN, NaN, NaN];

// Where among ascending times the last one at or before `time` is; 0 where all are later.
export function indexAt(times, time) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

// The instant of a stretch of GET /recordings/{name} at `time` [s].
export function instantOf(stretch, time) {
  const at = indexAt(stretch.times, time);
  return { time: stretch.times[at], bodies: stretch.bodies[at], qpos: stretch.qpos[at], tau: stretch.tau[at],
           feet: stretch.feet[at], tension: stretch.crane_tension[at] };
}

// As a snapshot of the scene's robot with `imus` inertial units. It has no tether and no contacts: where
// they were is not recorded.
export function snapshotOf(scene, imus, { time, bodies, qpos, tau, feet, tension }) {
  return {
    time, bodies, feet, recorded: true, faults: [], contacts: [], pushes: [], com: NONE,
    crane: { attached: false, tension },
    motors: scene.motors.map((motor, i) => ({
      q: qpos[motor.qpos] ?? NaN, dq: NaN, tau: tau[i] ?? NaN, casing: NaN, winding: NaN, errors: [], enabled: true,
      recorded: true })),
    imus: Array.from({ length: imus }, () => ({
      quaternion: [...NONE, NaN], gyroscope: NONE, accelerometer: NONE, temperature: NaN })),
    battery: { voltage: NaN, current: NaN, soc: NaN, temperature: NaN },
    remote: { keys: "", lx: NaN, ly: NaN, rx: NaN, ry: NaN },
  };
}
