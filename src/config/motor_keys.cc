// The keys of a robot's motors: makes, motors of body and hands, what is between them and joints.
#include <limits>

#include "config/keys.h"
#include "robot/hand_law.h"

namespace understudy::config {
namespace {

// Keys that motors of the body and of hands share.
void DescribeDrive(Archive& a, robot::MotorSpec& m) {
  a.Key(UNDERSTUDY_NVP(m.torque_limit),
        {"N·m", kNotNegative, "Most torque at the joint; 0 is that of its type through gear"});
  a.Key(UNDERSTUDY_NVP(m.knee_speed),
        {"rad/s", kNotNegative,
         "Speed up to which torque_limit is available; 0 is that of its type, and without one "
         "makes torque independent of speed"});
  a.Key(UNDERSTUDY_NVP(m.no_load_speed),
        {"rad/s", kNotNegative,
         "Speed at which the available driving torque is 0; 0 is that of its type"});
  a.Key(UNDERSTUDY_NVP(m.type),
        {"Its make, one of robot.motor_types; \"\" is one without losses at any voltage"});
  a.Key(UNDERSTUDY_NVP(m.gear),
        {"", {0.01, 100}, "Further reduction from the motor's own output to the joint"});
  a.Key(UNDERSTUDY_NVP(m.q_step),
        {"rad", kNotNegative, "Lattice of the reported angle; 0 is none"});
  a.Key(UNDERSTUDY_NVP(m.dq_step),
        {"rad/s", kNotNegative, "Lattice of the reported rate; 0 is none"});
  a.Key(UNDERSTUDY_NVP(m.tau_step),
        {"N·m", kNotNegative, "Lattice of the reported torque; 0 is none"});
  a.Key(UNDERSTUDY_NVP(m.zero_error),
        {"rad",
         {-3.2, 3.2},
         "What its encoder reads more than there is, beside what sensors.encoder.zero draws"});
  a.Key(UNDERSTUDY_NVP(m.armature),
        {"kg·m²", kNotNegative,
         "Rotor inertia at the joint, over any other; 0 keeps that of dynamics and model"});
  a.Key(UNDERSTUDY_NVP(m.strength),
        {"", {0, 100}, "Actual over intended torque; scales the limit too"});
  a.Key(UNDERSTUDY_NVP(m.kp_scale), {"", {0, 100}, "Effective over commanded kp"});
  a.Key(UNDERSTUDY_NVP(m.kd_scale), {"", {0, 100}, "Effective over commanded kd"});
}

void DescribeFitted(Archive& a, robot::FittedDynamicsSpec& f) {
  constexpr Range kOrModel{-1, std::numeric_limits<double>::infinity()};
  a.Key(UNDERSTUDY_NVP(f.slots),
        {"", {0, 34}, "Slots of the motors of these joints; slots without a motor are skipped"});
  a.Key(UNDERSTUDY_NVP(f.armature),
        {"kg·m²", kOrModel, "Rotor inertia at the joint; below 0 is the model's"});
  a.Key(UNDERSTUDY_NVP(f.damping),
        {"N·m·s/rad", kOrModel, "Damping of the joint; below 0 is the model's"});
  a.Key(UNDERSTUDY_NVP(f.frictionloss),
        {"N·m", kOrModel, "Dry friction of the joint; below 0 is the model's"});
  a.Key(
      UNDERSTUDY_NVP(f.kd_share),
      {"", {0, 10}, "Effective over commanded kd; for motors of a parallel pair in PR mode only"});
}

void DescribeHandMotor(Archive& a, robot::MotorSpec& m) {
  a.Key(UNDERSTUDY_NVP(m.joint), {"Joint of the model that it drives"});
  DescribeDrive(a, m);
  a.Key(UNDERSTUDY_NVP(m.lock_kd), {"N·m·s/rad", {0, 100}, "Damping gain while it is locked"});
  a.Key(UNDERSTUDY_NVP(m.span),
        {"rad",
         {-10, 10},
         "Angle of the joint where q of the messages is 0, and where it is 1; [0, 0] makes q the "
         "angle"});
  a.Key(UNDERSTUDY_NVP(m.hold_kp), {"N·m/rad", kNotNegative, "Gain of the hand's own controller"});
  a.Key(UNDERSTUDY_NVP(m.hold_kd), {"N·m·s/rad", kNotNegative, "Damping of that controller"});
}

void DescribePad(Archive& a, robot::PadSpec& p) {
  a.Key(UNDERSTUDY_NVP(p.site),
        {"Box site of the model that it is: z leaves the skin, x goes along a row, y to the row "
         "before. Without one it feels nothing"});
  a.Key(UNDERSTUDY_NVP(p.rows), {"", {1, 16}, "Rows of cells"});
  a.Key(UNDERSTUDY_NVP(p.columns), {"", {1, 16}, "Cells of a row"});
  a.Key(UNDERSTUDY_NVP(p.taxels),
        {"", {0, 11}, "Of the law dex3: the cells that there are; the others show no value"});
}

void DescribeTouch(Archive& a, robot::TouchSpec& t) {
  a.Key(UNDERSTUDY_NVP(t.hz),
        {"Hz", {0, 10000}, "Rate of the messages of touch, with the law inspire_ftp"});
  a.Key(UNDERSTUDY_NVP(t.counts_per_newton),
        {"counts/N", kNotNegative, "What a cell shows of a contact that sits on its middle"});
  a.Key(UNDERSTUDY_NVP(t.most_counts), {"counts", kNotNegative, "Most that it shows; 0 is any"});
  a.Key(UNDERSTUDY_NVP(t.noise_counts),
        {"counts", kNotNegative, "Standard deviation of the noise of a cell that feels something"});
  a.Key(
      UNDERSTUDY_NVP(t.spread),
      {"m",
       {0.0001, 0.1},
       "Standard deviation of the bell that a contact makes on the pad (the default is assumed)"});
}

}  // namespace

void DescribeMotorType(Archive& a, robot::MotorTypeSpec& t) {
  constexpr Range kTime{0.1, 1e6};
  a.Key(UNDERSTUDY_NVP(t.name), {"Its name, to which robot.motors[].type refers"});
  a.Key(UNDERSTUDY_NVP(t.torque_limit),
        {"N·m", kNotNegative, "Most torque at its own output, by its limit of current"});
  a.Key(UNDERSTUDY_NVP(t.knee_speed),
        {"rad/s", kNotNegative,
         "Speed up to which torque_limit is available; 0 makes torque independent of speed"});
  a.Key(UNDERSTUDY_NVP(t.no_load_speed),
        {"rad/s", kNotNegative, "Speed at which the available driving torque is 0"});
  a.Key(UNDERSTUDY_NVP(t.rated_v),
        {"V",
         {0, 1000},
         "Voltage of the bus from which on these speeds hold; below it they go down with it; 0 "
         "makes them independent of voltage"});
  a.Key(UNDERSTUDY_NVP(t.watt_per_nm2),
        {"W/(N·m)²", kNotNegative,
         "Loss of the winding at 25 °C per square of its own torque; grows with temperature"});
  a.Key(
      UNDERSTUDY_NVP(t.winding_c_per_w),
      {"°C/W", kNotNegative, "Rise of the winding over the casing; 0 is a motor that stays cool"});
  a.Key(UNDERSTUDY_NVP(t.casing_c_per_w),
        {"°C/W", kNotNegative, "Rise of the casing over the air; 0 is a casing that stays cool"});
  a.Key(UNDERSTUDY_NVP(t.winding_time),
        {"s", kTime, "Time constant of the winding towards the casing"});
  a.Key(UNDERSTUDY_NVP(t.casing_time), {"s", kTime, "Time constant of the casing towards the air"});
}

void DescribeMotor(Archive& a, robot::MotorSpec& m) {
  a.Key(UNDERSTUDY_NVP(m.joint), {"Joint of the model that it drives"});
  a.Key(UNDERSTUDY_NVP(m.slot),
        {"", {0, 34}, "Index in LowCmd.motor_cmd and LowState.motor_state"});
  DescribeDrive(a, m);
  a.Key(UNDERSTUDY_NVP(m.hold_kp), {"N·m/rad", kNotNegative, "Gain that holds a start pose"});
  a.Key(UNDERSTUDY_NVP(m.hold_kd), {"N·m·s/rad", kNotNegative, "Damping that holds a start pose"});
  a.Key(UNDERSTUDY_NVP(m.q_clamp),
        {"rad",
         {-100, 100},
         "Least and most q of a command, of the joint: what is beyond is taken for the end; [0, 0] "
         "takes any"});
}

void DescribeParallel(Archive& a, robot::ParallelSpec& p) {
  a.Key(UNDERSTUDY_NVP(p.pitch),
        {"", {0, 34}, "Motor order index of the pitch joint; its slot carries motor B"});
  a.Key(UNDERSTUDY_NVP(p.roll),
        {"", {0, 34}, "Motor order index of the roll joint; its slot carries motor A"});
  a.Key(UNDERSTUDY_NVP(p.roll_ratio),
        {"rad/rad", {0.01, 100}, "Difference of the angles of A and B per roll angle"});
}

void DescribeDynamics(Archive& a, robot::DynamicsSpec& d) {
  a.Choice(
      UNDERSTUDY_NVP(d.use),
      {"Joint friction, damping and armature: catalogue, as in the model's file, or fitted to "
       "recordings of real robots; setting robot.model selects catalogue unless this is set too"},
      {"catalogue", "fitted"});
  a.List(UNDERSTUDY_NVP(d.fitted), {"Fitted figures; joints without any keep the model's"},
         DescribeFitted);
  a.Key(UNDERSTUDY_NVP(d.delay),
        {"s", {0, 0.1}, "Delay from a command to its torque, rounded to physics steps"});
  a.Key(UNDERSTUDY_NVP(d.backlash),
        {"rad", {0, 0.2}, "Play between each motor, with its encoder, and its joint"});
  a.Key(UNDERSTUDY_NVP(d.ripple),
        {"", {0, 1}, "Share by which the torque of each motor swings as it turns"});
  a.Key(UNDERSTUDY_NVP(d.ripple_periods),
        {"", {1, 1e5}, "How often it does in a turn of the joint (the default is assumed)"});
}

void DescribeBus(Archive& a, robot::BusSpec& b) {
  a.Key(UNDERSTUDY_NVP(b.name), {"Its name, of which its faults are"});
  a.Key(UNDERSTUDY_NVP(b.slots), {"", {0, 34}, "Slots of the motors behind it"});
  a.Key(UNDERSTUDY_NVP(b.delay),
        {"s",
         {0, 0.1},
         "Least and most that a command takes on it besides robot.dynamics.delay, drawn evenly for "
         "each by sensors.seed; none overtakes another"});
}

void DescribeHand(Archive& a, robot::HandSpec& h) {
  a.Key(UNDERSTUDY_NVP(h.name), {"Its name"});
  a.Word(UNDERSTUDY_NVP(h.law), {"How it talks and obeys (docs/hands.md)"}, robot::HandLawNames());
  a.Key(UNDERSTUDY_NVP(h.models),
        {"Models of wrists with hands, which replace those of robot.model: absolute, or below "
         "models. Not used where robot.model has the motors' joints"});
  a.Key(UNDERSTUDY_NVP(h.topic),
        {"Its topics are rt/<topic>/cmd, rt/<topic>/state and, with the law dex3, "
         "rt/lf/<topic>/state; with the law inspire_ftp rt/<topic> with ctrl, state and touch for "
         "its *"});
  a.Key(UNDERSTUDY_NVP(h.hz), {"Hz", {1, 10000}, "Rate of its states"});
  a.List(UNDERSTUDY_NVP(h.motors), {"Its motors, in the order of the messages"}, DescribeHandMotor);
  a.Key(UNDERSTUDY_NVP(h.slot), {"", {0, 15}, "Index in the messages of its first motor"});
  a.Key(UNDERSTUDY_NVP(h.slots),
        {"", {0, 16}, "How many motors the messages have; 0 is as many as it has"});
  a.Key(UNDERSTUDY_NVP(h.sdk_slot),
        {"", {-1, 3}, "Index in rt/hand_sdk of its first motor; -1: that does not reach it"});
  a.List(UNDERSTUDY_NVP(h.pads), {"Pressure sensors, in the order of the messages"}, DescribePad);
  a.Section(UNDERSTUDY_NVP(h.touch), {"What the cells of those show"}, DescribeTouch);
  a.Key(UNDERSTUDY_NVP(h.timeout),
        {"s",
         {0.001, 3600},
         "Simulated time without a taken command after which watched motors lock"});
  a.Key(UNDERSTUDY_NVP(h.temperature_c), {"°C", {-100, 150}, "Temperature that pads show"});
  a.Key(UNDERSTUDY_NVP(h.supply_v), {"V", {0, 100}, "Voltage that power_v shows"});
}

void DescribeThermal(Archive& a, robot::ThermalSpec& t) {
  a.Key(UNDERSTUDY_NVP(t.ambient_c), {"°C", {-50, 80}, "Air temperature"});
  a.Key(UNDERSTUDY_NVP(t.rest_rise_c),
        {"°C", kNotNegative, "Temperature of an idle motor above ambient"});
  a.Key(UNDERSTUDY_NVP(t.derate_c),
        {"°C",
         {0, 300},
         "Temperature of a winding from which on its motor gives less torque, down to half at "
         "trip_c"});
  a.Key(UNDERSTUDY_NVP(t.trip_c),
        {"°C", {0, 300}, "Temperature of a winding at which its motor gives no torque"});
}

}  // namespace understudy::config
