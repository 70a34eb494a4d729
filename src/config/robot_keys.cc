#include <limits>

#include "authority/chord.h"
#include "config/keys.h"

namespace understudy::config {
namespace {

// What motors of hands have too.
void DescribeDrive(Archive& a, robot::MotorSpec& m) {
  a.Key({"torque_limit", "N·m", kNotNegative, "Most torque at the joint"}, &m.torque_limit);
  a.Key({"knee_speed", "rad/s", kNotNegative,
         "Speed up to which torque_limit is to be had; 0 leaves torque independent of speed"},
        &m.knee_speed);
  a.Key({"no_load_speed", "rad/s", kNotNegative, "Speed at which no driving torque is left"},
        &m.no_load_speed);
}

void DescribeMotor(Archive& a, robot::MotorSpec& m) {
  a.Key({"joint", "Joint of the model that it drives"}, &m.joint);
  a.Key({"slot", "", {0, 34}, "Index in LowCmd.motor_cmd and LowState.motor_state"}, &m.slot);
  DescribeDrive(a, m);
  a.Key({"q_step", "rad", kNotNegative, "Lattice of the reported angle; 0 is none"}, &m.q_step);
  a.Key({"dq_step", "rad/s", kNotNegative, "Lattice of the reported rate; 0 is none"}, &m.dq_step);
  a.Key({"tau_step", "N·m", kNotNegative, "Lattice of the reported torque; 0 is none"},
        &m.tau_step);
  a.Key({"hold_kp", "N·m/rad", kNotNegative, "Gain that holds a start pose"}, &m.hold_kp);
  a.Key({"hold_kd", "N·m·s/rad", kNotNegative, "Damping that holds a start pose"}, &m.hold_kd);
  a.Key({"armature", "kg·m²", kNotNegative,
         "Inertia of its rotor at the joint, over any other; 0 leaves that of dynamics and model"},
        &m.armature);
  a.Key({"strength", "", {0, 100}, "Torque that it gives over the torque meant, limit included"},
        &m.strength);
  a.Key({"kp_scale", "", {0, 100}, "How much of a commanded kp acts"}, &m.kp_scale);
  a.Key({"kd_scale", "", {0, 100}, "How much of a commanded kd acts"}, &m.kd_scale);
}

void DescribeBody(Archive& a, robot::BodySpec& b) {
  a.Key({"name", "Body of the model"}, &b.name);
  a.Key({"pos", "m", {-10, 10}, "Its place in its parent's frame; none is the model's"}, &b.pos);
  a.Key({"mass", "kg", {0, 1000}, "Its mass; 0 is the model's"}, &b.mass);
  a.Key({"com", "m", {-10, 10}, "Its centre of mass in its own frame; none is the model's"},
        &b.com);
  a.Key({"inertia",
         "kg·m²",
         {-1000, 1000},
         "Its inertia about that, xx yy zz xy xz yz in its own frame; none is the model's"},
        &b.inertia);
}

void DescribeSite(Archive& a, robot::SiteSpec& s) {
  a.Key({"name", "Site of the model"}, &s.name);
  a.Key({"pos", "m", {-10, 10}, "Its place in its body's frame"}, &s.pos, 3);
}

void DescribeParallel(Archive& a, robot::ParallelSpec& p) {
  a.Key({"pitch", "", {0, 34}, "Motor order index of the pitch joint; its slot carries motor B"},
        &p.pitch);
  a.Key({"roll", "", {0, 34}, "Motor order index of the roll joint; its slot carries motor A"},
        &p.roll);
  a.Key({"roll_ratio", "rad/rad", {0.01, 100}, "How far A and B part per roll angle"},
        &p.roll_ratio);
}

void DescribeFitted(Archive& a, robot::FittedDynamicsSpec& f) {
  constexpr Range kOrModel{-1, std::numeric_limits<double>::infinity()};
  a.Key({"slots",
         "",
         {0, 34},
         "Slots of the motors whose joints these are; empty ones are passed over"},
        &f.slots);
  a.Key({"armature", "kg·m²", kOrModel, "Rotor inertia at the joint; below 0 is the model's"},
        &f.armature);
  a.Key({"damping", "N·m·s/rad", kOrModel, "Damping of the joint; below 0 is the model's"},
        &f.damping);
  a.Key({"frictionloss", "N·m", kOrModel, "Dry friction of the joint; below 0 is the model's"},
        &f.frictionloss);
  a.Key({"kd_share",
         "",
         {0, 10},
         "How much of a commanded kd acts; of motors of a parallel pair in PR mode only"},
        &f.kd_share);
}

void DescribeDynamics(Archive& a, robot::DynamicsSpec& d) {
  a.Choice({"use",
            "Figures of joints and drives: catalogue, those of the model's file, or fitted to "
            "recordings of real robots; another robot.model has its own unless this is said again"},
           {"catalogue", "fitted"}, &d.use);
  a.List({"fitted", "What the fit says; what it does not say is the model's"}, &d.fitted,
         DescribeFitted);
  a.Key({"delay",
         "s",
         {0, 0.1},
         "Time from when motors would follow a command to its torque, to the nearest step"},
        &d.delay);
}

void DescribeHandMotor(Archive& a, robot::MotorSpec& m) {
  a.Key({"joint", "Joint of the model that it drives"}, &m.joint);
  DescribeDrive(a, m);
}

void DescribePad(Archive& a, robot::PadSpec& p) {
  a.Key({"taxels", "", {0, 11}, "Places in pressure that it has; the others show no value"},
        &p.taxels);
}

void DescribeHand(Archive& a, robot::HandSpec& h) {
  a.Key({"name", "Its name"}, &h.name);
  a.Key({"topic", "Its topics are rt/<topic>/cmd, rt/<topic>/state and rt/lf/<topic>/state"},
        &h.topic);
  a.List({"motors", "Its motors, in the order of motor_cmd and motor_state"}, &h.motors,
         DescribeHandMotor);
  a.List({"pads", "What feels pressure, in the order of press_sensor_state"}, &h.pads, DescribePad);
  a.Key({"timeout",
         "s",
         {0.001, 3600},
         "Simulated time without a taken command until motors lock that commands have watched"},
        &h.timeout);
  a.Key({"lock_kd", "N·m·s/rad", {0, 100}, "Gain with which a locked motor brakes"}, &h.lock_kd);
  a.Key({"temperature_c", "°C", {-100, 150}, "Temperature that motors and pads show"},
        &h.temperature_c);
  a.Key({"supply_v", "V", {0, 100}, "Voltage that power_v shows"}, &h.supply_v);
}

void DescribeFoot(Archive& a, robot::FootSpec& f) {
  a.Key({"name", "Its name"}, &f.name);
  a.Key({"geoms", "Geoms of the model whose contacts are this foot's"}, &f.geoms);
  a.Key(
      {"axis",
       "",
       {-1, 1},
       "Direction that the sensor feels, in the frame of the geoms' body; 0 0 0 is each contact's "
       "normal"},
      &f.axis);
}

void DescribePose(Archive& a, robot::PoseSpec& p) {
  a.Key({"q", "rad", {-10, 10}, "Joint angles in motor order"}, &p.q);
  a.Key({"height", "m", {0, 10}, "Height of the base"}, &p.height);
  a.Key({"quat", "", {-1, 1}, "Orientation of the base, w x y z"}, &p.quat);
}

void DescribeRates(Archive& a, robot::RateSpec& r) {
  constexpr Range kHz{1, 10000};
  a.Key({"lowstate_hz", "Hz", kHz, "Rate of rt/lowstate and rt/secondary_imu"}, &r.lowstate_hz);
  a.Key({"motion_hz", "Hz", kHz, "Rate of rt/sportmodestate or rt/odommodestate"}, &r.motion_hz);
  a.Key({"hand_hz", "Hz", kHz, "Rate of the states of hands (the default is assumed)"}, &r.hand_hz);
  a.Key({"lf_hz", "Hz", kHz, "Rate of all rt/lf topics"}, &r.lf_hz);
  a.Key({"service_hz", "Hz", kHz, "Rate of the commands of the robot's own motion service"},
        &r.service_hz);
}

void DescribeService(Archive& a, robot::ServiceSpec& s) {
  a.Key({"name", "Its name, as robot_state lists it"}, &s.name);
  a.Key({"alias", "What motion_switcher calls it; \"\" when it moves no motors"}, &s.alias);
  a.Key({"on", "Whether it runs after boot; of motion services, motion.service says which"}, &s.on);
  a.Key({"protect", "Whether it refuses to be switched"}, &s.protect);
  a.Key({"since", "Firmware from which on it is there; \"\" is always"}, &s.since);
  a.Key({"before", "Firmware from which on it is gone; \"\" is never"}, &s.before);
}

void DescribeArmSdk(Archive& a, robot::ArmSdkSpec& s) {
  a.Key({"slots", "", {0, 34}, "Slots of the motors it moves; none where there is no rt/arm_sdk"},
        &s.slots);
  a.Key({"weight_slot", "", {0, 34}, "Slot whose q is the weight, 0 to 1"}, &s.weight_slot);
  a.Key({"weight_in_mode_pr", "Whether mode_pr is the weight in percent, as on R1"},
        &s.weight_in_mode_pr);
  a.Key({"timeout", "s", {0, 3600}, "Age at which a command no longer counts; 0 is never"},
        &s.timeout);
}

void DescribeChord(Archive& a, robot::ChordSpec& c) {
  a.Key({"keys", "Keys that are held, as in L2+B"}, &c.keys);
  a.Key({"clicks", "", {1, 2}, "How often the last of them is pressed within half a second"},
        &c.clicks);
  a.Word({"does", "What the robot is asked for"}, authority::ChordActions(), &c.does);
  a.Key({"value", "", {0, 1e6}, "State or action id, where that takes one"}, &c.value);
  a.Key({"from", "", {0, 1e6}, "Ids of the states in which it works; none is all"}, &c.from);
}

void DescribeRemote(Archive& a, robot::RemoteSpec& r) {
  a.List({"chords", "What keys do while the motion service is on"}, &r.chords, DescribeChord);
  a.Key({"speed", "m/s, rad/s", {0, 10}, "Forward, left and turning speed of sticks fully moved"},
        &r.speed, 3);
}

void DescribeImu(Archive& a, robot::ImuSpec& i) {
  a.Key({"site", "Site of the model where LowState's unit is"}, &i.site);
  a.Key({"secondary_site", "Site of the second unit; \"\" where there is none"}, &i.secondary_site);
  a.Key({"gyro_step", "rad/s", kNotNegative, "Lattice of the gyroscope; 0 is none"}, &i.gyro_step);
  a.Key({"accel_step", "m/s²", kNotNegative, "Lattice of the accelerometer; 0 is none"},
        &i.accel_step);
  a.Key({"gyro_noise", "rad/s", kNotNegative, "Standard deviation of the gyroscope"},
        &i.gyro_noise);
  a.Key({"accel_noise", "m/s²", kNotNegative, "Standard deviation of the accelerometer"},
        &i.accel_noise);
  a.Key({"temperature_c", "°C", {-100, 150}, "Temperature it shows when warm"}, &i.temperature_c);
}

void DescribeEncoderNoise(Archive& a, robot::EncoderNoiseSpec& n) {
  constexpr Range kSteps{0, 1000};
  a.Key({"q_steps", "steps", kSteps, "Standard deviation of the angle"}, &n.q_steps);
  a.Key({"dq_steps", "steps", kSteps, "Standard deviation of the rate"}, &n.dq_steps);
  a.Key({"tau_steps", "steps", kSteps, "Standard deviation of the torque"}, &n.tau_steps);
}

void DescribeFootSensor(Archive& a, robot::FootSensorSpec& f) {
  a.Key({"offset_counts", "counts", {0, 4095}, "Raw value of an unloaded foot"}, &f.offset_counts);
  a.Key({"counts_per_newton", "counts/N", kNotNegative, "Slope of the raw value"},
        &f.counts_per_newton);
}

void DescribeBattery(Archive& a, robot::BatterySpec& b) {
  a.Key({"cells", "", {0, 40}, "Cells in series"}, &b.cells);
  a.Key({"capacity_ah", "A·h", kNotNegative, "Capacity"}, &b.capacity_ah);
  a.Key({"start_soc", "", {0, 1}, "State of charge at the start, 1 is full"}, &b.start_soc);
  a.Key({"cell_full_v", "V", {0, 5}, "Voltage of an unloaded full cell"}, &b.cell_full_v);
  a.Key({"cell_empty_v", "V", {0, 5}, "Voltage of an unloaded empty cell"}, &b.cell_empty_v);
  a.Key({"internal_ohm", "ohm", kNotNegative, "Resistance of the pack"}, &b.internal_ohm);
  a.Key({"idle_a", "A", kNotNegative, "Current with all motors passive"}, &b.idle_a);
  a.Key({"watt_per_nm2", "W/(N·m)²", kNotNegative, "Heat per square of joint torque"},
        &b.watt_per_nm2);
}

void DescribeThermal(Archive& a, robot::ThermalSpec& t) {
  a.Key({"ambient_c", "°C", {-50, 80}, "Air temperature"}, &t.ambient_c);
  a.Key({"rest_rise_c", "°C", kNotNegative, "How much warmer an idle motor is"}, &t.rest_rise_c);
  a.Key({"rise_per_nm2_c", "°C/(N·m)²", kNotNegative, "Steady rise per square of its torque"},
        &t.rise_per_nm2_c);
  a.Key({"time_constant", "s", {1, 1e6}, "Time constant of the rise"}, &t.time_constant);
}

void DescribeHumanoidMotion(Archive& a, robot::HumanoidMotionSpec& h) {
  constexpr Range kId{-1, 1000};
  a.Key({"lock_stand", "", kId, "State with joints locked, standing; -1 is not a humanoid"},
        &h.lock_stand);
  a.Key({"balance", "", kId, "States that stand balanced, the usual one first"}, &h.balance);
  a.Key({"squat", "", kId, "State with joints locked in squat_q; -1 is none"}, &h.squat);
  a.Key({"sit", "", kId, "State with joints locked in sit_q; -1 is none"}, &h.sit);
  a.Key({"balanced_squat", "", kId, "State that squats down balanced and rises again; -1 is none"},
        &h.balanced_squat);
  a.Key({"unplayed", "", kId, "States that the robot has and nothing here plays"}, &h.unplayed);
  a.Key({"squat_q", "rad", {-10, 10}, "Joint angles of the squat in motor order"}, &h.squat_q);
  a.Key({"sit_q", "rad", {-10, 10}, "Joint angles of sitting in motor order"}, &h.sit_q);
  a.Key({"arm_actions", "Whether the robot has the arm action service"}, &h.arm_actions);
}

void DescribeQuadrupedMotion(Archive& a, robot::QuadrupedMotionSpec& m) {
  a.Key({"stand_height", "m", {0, 2}, "Height of the base standing; 0 is not a quadruped"},
        &m.stand_height);
  a.Key({"foot_x", "m", {-1, 1}, "How far the feet stand ahead of the hips"}, &m.foot_x);
  a.Key({"height_range", "m", {-1, 1}, "Least and most that it may be over stand_height"},
        &m.height_range, 2);
  a.Key({"euler_range", "rad", {0, 1.5}, "Most roll, pitch, yaw of the body either way"},
        &m.euler_range, 3);
  a.Key({"sit", "", {-2, 2}, "Base when sitting: m ahead, m over stand_height, rad of pitch"},
        &m.sit, 3);
  a.Key({"kp", "N·m/rad", {1, 1e5}, "Gain of the legs' joints"}, &m.kp);
  a.Key({"kd", "N·m·s/rad", kNotNegative, "Damping of the legs' joints"}, &m.kd);
  a.Key({"damping_kd", "N·m·s/rad", kNotNegative, "Damping of all joints when damped"},
        &m.damping_kd);
  a.Key({"wheel_kp", "N·m/rad", kNotNegative, "Gain that keeps wheels in place while balancing"},
        &m.wheel_kp);
  a.Key({"wheel_kd", "N·m·s/rad", kNotNegative, "Damping that brakes wheels"}, &m.wheel_kd);
}

}  // namespace

void Describe(Archive& a, robot::RobotSpec& r) {
  a.Key({"name", "Short name"}, &r.name);
  a.Key({"description", "What it is, in a line"}, &r.description);
  a.Key({"model", "Model file: absolute, seen from the YAML that names it, or below models"},
        &r.model);
  a.Key({"base_body", "Body of the model that moves freely"}, &r.base_body);
  a.Choice({"family", "Message family on rt/lowcmd and rt/lowstate"}, {"go", "hg"}, &r.family);
  a.Key({"firmware", "Version of the robot's software that is played"}, &r.firmware);
  a.Word({"form", "motion_switcher's word: 0 legged, 1 wheel-legged"}, {"0", "1"}, &r.form);
  a.Key({"state_id_since",
         "Firmware from which on states are told by the state machine's id: in go's SportModeState "
         "in error_code, in hg on rt/sportmodestate; \"\" is never"},
        &r.state_id_since);
  a.Key({"mode_machine", "", {0, 255}, "Robot type that an hg robot announces and commands echo"},
        &r.mode_machine);
  a.Key({"revision",
         "Hardware revision, one of those that the robot's file lists under robot.revisions; \"\" "
         "is none"},
        &r.revision);
  a.Key(
      {"locked_joints",
       "Joints that have no motor here and cannot move: theirs is left out of robot.motors and of "
       "every pose, and the model holds them fast where it has them"},
      &r.locked_joints);
  a.List({"bodies", "Bodies that differ from the model file"}, &r.bodies, DescribeBody,
         &robot::BodySpec::name);
  a.List({"sites", "Sites that differ from the model file"}, &r.sites, DescribeSite,
         &robot::SiteSpec::name);
  a.List({"motors", "Motors in motor order, which is ascending slot"}, &r.motors, DescribeMotor,
         &robot::MotorSpec::joint);
  a.List({"parallel", "Pairs of joints that two parallel motors drive together"}, &r.parallel,
         DescribeParallel);
  a.Section(
      {"dynamics", "Friction, damping and inertia of joints; drives"},
      [&] { DescribeDynamics(a, r.dynamics); }, "use");
  a.List({"hands", "Hands that have motors of their own; hg only"}, &r.hands, DescribeHand);
  a.Section({"imu", "Inertial units"}, [&] { DescribeImu(a, r.imu); });
  a.Section({"encoder_noise", "Noise of motor readings, in steps of the motor's own lattice"},
            [&] { DescribeEncoderNoise(a, r.encoder_noise); });
  a.List({"feet", "Feet, in the order of foot_force"}, &r.feet, DescribeFoot,
         &robot::FootSpec::name);
  a.Section({"foot_sensor", "What foot_force shows"},
            [&] { DescribeFootSensor(a, r.foot_sensor); });
  a.Section({"rates", "How often topics are written"}, [&] { DescribeRates(a, r.rates); });
  a.List({"services", "Programs on the robot's own computer"}, &r.services, DescribeService,
         &robot::ServiceSpec::name);
  a.Section({"arm_sdk", "rt/arm_sdk: commands mixed over the motion service's"},
            [&] { DescribeArmSdk(a, r.arm_sdk); });
  a.Key({"user_lowcmd", "Whether the motion service can hand the motors to rt/user_lowcmd"},
        &r.user_lowcmd);
  a.Section({"remote", "The remote controller"}, [&] { DescribeRemote(a, r.remote); });
  a.Section({"battery", "The battery"}, [&] { DescribeBattery(a, r.battery); });
  a.Section({"thermal", "How warm motors get"}, [&] { DescribeThermal(a, r.thermal); });
  a.Section({"lying", "Pose on the ground, passive"}, [&] { DescribePose(a, r.lying); });
  a.Section({"standing", "Pose of standing"}, [&] { DescribePose(a, r.standing); });
  a.Section({"hanging", "Pose on the crane or clamped"}, [&] { DescribePose(a, r.hanging); });
  a.Section({"motion", "The robot's own motion service"}, [&] {
    a.Section({"humanoid", "State machine of a humanoid"},
              [&] { DescribeHumanoidMotion(a, r.motion.humanoid); });
    a.Section({"quadruped", "How a quadruped stands and moves"},
              [&] { DescribeQuadrupedMotion(a, r.motion.quadruped); });
  });
  a.Key({"crane_body", "Body of the model that the crane's hook is in"}, &r.crane_body);
  a.Key({"crane_point", "m", {-5, 5}, "The hook in that body's frame"}, &r.crane_point, 3);
  a.Word({"default_start", "Pose a run starts in unless start.pose says otherwise"}, StartPoses(),
         &r.default_start);
}

}  // namespace understudy::config
