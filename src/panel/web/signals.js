// Everything a snapshot tells that can be plotted, by name.

const MOTOR = [
  ["q", "rad", "position"],
  ["dq", "rad/s", "speed"],
  ["tau", "N·m", "torque"],
  ["casing", "°C", "casing"],
  ["winding", "°C", "winding"],
];
const COMMAND = [
  ["q", "rad", "commanded position"],
  ["dq", "rad/s", "commanded speed"],
  ["tau", "N·m", "feed-forward"],
  ["kp", "N·m/rad", "kp"],
  ["kd", "N·m·s/rad", "kd"],
];
const BATTERY = [
  ["voltage", "V"], ["current", "A"], ["soc", ""], ["temperature", "°C"],
];
// What the vendor's marks for "no position" and "no velocity" exceed; such a command is no line.
const NO_COMMAND = 15000;

// Roll, pitch, yaw [rad] of w x y z, as rpy on the wire.
export function rollPitchYaw([w, x, y, z]) {
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

export const shortName = (motor) => motor.name.replace(/_joint$/, "");

// Rows of {name, unit, read(snapshot)}; a value that a snapshot lacks reads as NaN.
export function signalsOf(scene, snapshot) {
  const signals = [];
  const add = (name, unit, read) => signals.push({
    name, unit, read: (now) => {
      const value = read(now);
      return typeof value === "number" ? value : NaN;
    },
  });

  scene.motors.forEach((motor, i) => {
    const name = shortName(motor);
    for (const [field, unit, word] of MOTOR) {
      add(`${name} ${word}`, unit, (f) => f.motors[i]?.[field]);
    }
    for (const [field, unit, word] of COMMAND) {
      add(`${name} ${word}`, unit, (f) => {
        const value = f.command?.[i]?.[field];
        return Math.abs(value) < NO_COMMAND ? value : NaN;
      });
    }
  });
  snapshot.imus.forEach((_, i) => {
    const name = i === 0 ? "imu" : (scene.imus?.[i] ?? `imu ${i + 1}`);
    ["roll", "pitch", "yaw"].forEach((axis, k) => {
      add(`${name} ${axis}`, "rad", (f) => rollPitchYaw(f.imus[i].quaternion)[k]);
    });
    ["w", "x", "y", "z"].forEach((axis, k) => {
      add(`${name} quaternion ${axis}`, "", (f) => f.imus[i].quaternion[k]);
    });
    ["x", "y", "z"].forEach((axis, k) => {
      add(`${name} gyroscope ${axis}`, "rad/s", (f) => f.imus[i].gyroscope[k]);
      add(`${name} accelerometer ${axis}`, "m/s²", (f) => f.imus[i].accelerometer[k]);
    });
    add(`${name} temperature`, "°C", (f) => f.imus[i].temperature);
  });
  for (const [field, unit] of BATTERY) add(`battery ${field}`, unit, (f) => f.battery[field]);
  snapshot.feet.forEach((_, i) => {
    add(`foot ${scene.feet?.[i] ?? i} force`, "N", (f) => f.feet[i]);
  });
  ["x", "y", "z"].forEach((axis, k) => {
    add(`base ${axis}`, "m", (f) => f.bodies[scene.base]?.[k]);
    add(`centre of mass ${axis}`, "m", (f) => f.com[k]);
  });
  for (const stick of ["lx", "ly", "rx", "ry"]) add(`remote ${stick}`, "", (f) => f.remote[stick]);
  add("crane tension", "N", (f) => f.crane.tension);
  return signals;
}
