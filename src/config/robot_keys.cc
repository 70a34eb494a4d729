// The keys of a robot. Those of its motors: motor_keys.cc; of its motion service: motion_keys.cc.
#include "authority/chord.h"
#include "config/keys.h"
#include "motion/controllers.h"

namespace understudy::config {
namespace {

void DescribeBody(Archive& a, robot::BodySpec& b) {
  a.Key(UNDERSTUDY_NVP(b.name), {"Body of the model"});
  a.Key(UNDERSTUDY_NVP(b.pos),
        {"m", {-10, 10}, "Position in the parent's frame; [] keeps the model's"});
  a.Key(UNDERSTUDY_NVP(b.mass), {"kg", {0, 1000}, "Its mass; 0 is the model's"});
  a.Key(UNDERSTUDY_NVP(b.com),
        {"m", {-10, 10}, "Centre of mass in the body's frame; [] keeps the model's"});
  a.Key(UNDERSTUDY_NVP(b.inertia), {"kg·m²",
                                    {-1000, 1000},
                                    "Inertia about the centre of mass, xx yy zz xy xz yz in the "
                                    "body's frame; [] keeps the model's"});
}

void DescribeSite(Archive& a, robot::SiteSpec& s) {
  a.Key(UNDERSTUDY_NVP(s.name),
        {"Site of the model; the base gets that of robot.imu.site where the model has none"});
  a.Key(UNDERSTUDY_NVP(s.pos), {"m", {-10, 10}, "Its place in its body's frame"});
}

void DescribeFan(Archive& a, robot::FanSpec& f) {
  a.Key(UNDERSTUDY_NVP(f.name), {"Its name, of which its faults are"});
  a.Key(UNDERSTUDY_NVP(f.place), {"", {0, 2}, "Its index in fan_frequency of LowState"});
  a.Key(UNDERSTUDY_NVP(f.rpm), {"1/min", {0, 10000}, "Value there while it turns"});
  a.Key(UNDERSTUDY_NVP(f.stall_bit),
        {"", {0, 255}, "Bit of fan_frequency[3] while it does not; 0 is none"});
}

void DescribeBoard(Archive& a, robot::BoardSpec& b) {
  a.Key(UNDERSTUDY_NVP(b.centre_rise_c),
        {"°C", {0, 100}, "temperature_ntc1 over the air while all fans turn"});
  a.Key(UNDERSTUDY_NVP(b.charger_rise_c),
        {"°C", {0, 100}, "temperature_ntc2 over the air while all fans turn"});
  a.Key(UNDERSTUDY_NVP(b.still_air), {"", {1, 10}, "Times that rise where no fan turns (assumed)"});
  a.Key(UNDERSTUDY_NVP(b.time_constant),
        {"s", {0.1, 1e5}, "In which temperatures follow (assumed)"});
}

void DescribeFoot(Archive& a, robot::FootSpec& f) {
  a.Key(UNDERSTUDY_NVP(f.name), {"Its name"});
  a.Key(UNDERSTUDY_NVP(f.geoms), {"Geoms of the model whose contacts are this foot's"});
  a.Key(UNDERSTUDY_NVP(f.axis), {"",
                                 {-1, 1},
                                 "Direction in which the sensor measures, in the frame of the "
                                 "geoms' body; 0 0 0 is each contact's "
                                 "normal"});
}

void DescribePose(Archive& a, robot::PoseSpec& p) {
  a.Key(UNDERSTUDY_NVP(p.q), {"rad", {-10, 10}, "Joint angles in motor order"});
  a.Key(UNDERSTUDY_NVP(p.height), {"m", {0, 10}, "Height of the base"});
  a.Key(UNDERSTUDY_NVP(p.quat), {"", {-1, 1}, "Orientation of the base, w x y z"});
}

void DescribeRates(Archive& a, robot::RateSpec& r) {
  constexpr Range kHz{1, 10000};
  a.Key(UNDERSTUDY_NVP(r.lowstate_hz), {"Hz", kHz, "Rate of rt/lowstate and rt/secondary_imu"});
  a.Key(UNDERSTUDY_NVP(r.motion_hz), {"Hz", kHz, "Rate of rt/sportmodestate or rt/odommodestate"});
  a.Key(UNDERSTUDY_NVP(r.lf_hz), {"Hz", kHz, "Rate of all rt/lf topics"});
  a.Key(UNDERSTUDY_NVP(r.service_hz),
        {"Hz", kHz, "Rate of the commands of the robot's own motion service"});
}

void DescribeService(Archive& a, robot::ServiceSpec& s) {
  a.Key(UNDERSTUDY_NVP(s.name), {"Its name, as robot_state lists it"});
  a.Key(UNDERSTUDY_NVP(s.alias), {"What motion_switcher calls it; \"\" when it moves no motors"});
  a.Key(UNDERSTUDY_NVP(s.on),
        {"Whether it runs after boot; for motion services motion.service decides"});
  a.Key(UNDERSTUDY_NVP(s.protect), {"Whether requests to switch it on or off are refused"});
  a.Key(UNDERSTUDY_NVP(s.since), {"First firmware that has it; \"\" is any"});
  a.Key(UNDERSTUDY_NVP(s.before), {"First firmware that no longer has it; \"\" is none"});
  a.Key(UNDERSTUDY_NVP(s.version), {"Its version, as robot_state tells it; \"\" tells none"});
  a.Word(UNDERSTUDY_NVP(s.controller),
         {"Controller of a motion service (docs/reference/policies.md); default is that of the "
          "robot's kind"},
         motion::ControllerNames());
  a.Key(UNDERSTUDY_NVP(s.policy),
        {"Definition that the controller policy plays, a YAML file: absolute, or relative to the "
         "YAML that names it"});
}

void DescribeArmSdk(Archive& a, robot::ArmSdkSpec& s) {
  a.Key(UNDERSTUDY_NVP(s.slots),
        {"", {0, 34}, "Slots of the motors it moves; [] if the robot has no rt/arm_sdk"});
  a.Key(UNDERSTUDY_NVP(s.weight_slot), {"", {0, 34}, "Slot whose q is the weight, 0 to 1"});
  a.Key(UNDERSTUDY_NVP(s.weight_in_mode_pr),
        {"Whether mode_pr is the weight in percent, as on R1"});
  a.Key(UNDERSTUDY_NVP(s.timeout), {"s", {0, 3600}, "Age at which a command expires; 0 is never"});
}

void DescribeChord(Archive& a, robot::ChordSpec& c) {
  a.Key(UNDERSTUDY_NVP(c.keys), {"Keys held together, as in L2+B"});
  a.Key(UNDERSTUDY_NVP(c.clicks), {"", {1, 2}, "Presses of the last key within half a second"});
  a.Word(UNDERSTUDY_NVP(c.does), {"What the robot is asked for"}, authority::ChordActions());
  a.Key(UNDERSTUDY_NVP(c.value),
        {"", {0, 1e6}, "Id of the state or arm action, for goals that take one"});
  a.Key(UNDERSTUDY_NVP(c.from), {"", {0, 1e6}, "Ids of the states in which it works; [] is all"});
}

void DescribeRemote(Archive& a, robot::RemoteSpec& r) {
  a.List(UNDERSTUDY_NVP(r.chords), {"Chords that work while the motion service is on"},
         DescribeChord);
  a.Key(UNDERSTUDY_NVP(r.speed),
        {"m/s, rad/s", {0, 10}, "Forward, left and turning speed at full stick"});
}

void DescribeImu(Archive& a, robot::ImuSpec& i) {
  a.Key(UNDERSTUDY_NVP(i.site), {"Site of the model at which LowState's IMU is"});
  a.Key(UNDERSTUDY_NVP(i.secondary_site), {"Site of the second unit; \"\" where there is none"});
  a.Key(UNDERSTUDY_NVP(i.gyro_step),
        {"rad/s", kNotNegative, "Lattice of the gyroscope; 0 is none"});
  a.Key(UNDERSTUDY_NVP(i.accel_step),
        {"m/s²", kNotNegative, "Lattice of the accelerometer; 0 is none"});
  a.Key(UNDERSTUDY_NVP(i.gyro_noise),
        {"rad/s", kNotNegative, "Standard deviation of the gyroscope"});
  a.Key(UNDERSTUDY_NVP(i.accel_noise),
        {"m/s²", kNotNegative, "Standard deviation of the accelerometer"});
  a.Key(UNDERSTUDY_NVP(i.temperature_c), {"°C", {-100, 150}, "Temperature it shows when warm"});
}

void DescribeEncoderNoise(Archive& a, robot::EncoderNoiseSpec& n) {
  constexpr Range kSteps{0, 1000};
  a.Key(UNDERSTUDY_NVP(n.q_steps), {"steps", kSteps, "Standard deviation of the angle"});
  a.Key(UNDERSTUDY_NVP(n.dq_steps), {"steps", kSteps, "Standard deviation of the rate"});
  a.Key(UNDERSTUDY_NVP(n.tau_steps), {"steps", kSteps, "Standard deviation of the torque"});
  a.Key(UNDERSTUDY_NVP(n.tau),
        {"N·m", {0, 1000}, "Standard deviation of the torque besides, alike for every motor"});
}

void DescribeFootSensor(Archive& a, robot::FootSensorSpec& f) {
  a.Key(UNDERSTUDY_NVP(f.offset_counts), {"counts", {0, 4095}, "Raw value of an unloaded foot"});
  a.Key(UNDERSTUDY_NVP(f.counts_per_newton), {"counts/N", kNotNegative, "Slope of the raw value"});
}

void DescribeLidar(Archive& a, robot::LidarSpec& l) {
  a.Word(UNDERSTUDY_NVP(l.make), {"Its make; none is without rt/utlidar"},
         {"none", "L1", "L2", "Mid-360"});
  a.Key(UNDERSTUDY_NVP(l.body), {"Body of the model that carries it; empty is the base"});
  a.Key(UNDERSTUDY_NVP(l.pos), {"m", {-5, 5}, "Place of its frame in the body's"});
  a.Key(UNDERSTUDY_NVP(l.rpy), {"rad", {-4, 4}, "Roll, pitch, yaw of its frame in the body's"});
  a.Key(UNDERSTUDY_NVP(l.base_pos),
        {"m", {-5, 5}, "Place of its frame by which rt/utlidar/cloud_base is made"});
  a.Key(UNDERSTUDY_NVP(l.noise), {"m", {0, 1}, "Standard deviation of a range"});
  a.Key(UNDERSTUDY_NVP(l.dropout), {"", {0, 1}, "Share of echoes that are lost"});
  a.Key(UNDERSTUDY_NVP(l.range), {"m", {0, 1000}, "The nearest and the farthest echo"});
}

void DescribeCamera(Archive& a, robot::CameraSpec& c) {
  a.Key(UNDERSTUDY_NVP(c.name), {"Its name, as `picture --camera` takes it"});
  a.Key(UNDERSTUDY_NVP(c.service),
        {"The service that gives its pictures, where robot.apis has it; \"\" is none"});
  a.Key(UNDERSTUDY_NVP(c.body), {"Body of the model that carries it; empty is the base"});
  a.Key(UNDERSTUDY_NVP(c.pos), {"m", {-5, 5}, "Place of its frame in the body's"});
  a.Key(UNDERSTUDY_NVP(c.rpy),
        {"rad", {-4, 4}, "Roll, pitch, yaw of its frame, which looks along x, in the body's"});
  a.Key(UNDERSTUDY_NVP(c.baseline),
        {"m",
         {0, 1},
         "Distance of its two eyes, half of it to each side: their pictures stand side by side, "
         "left first; 0 is one eye"});
  a.Key(UNDERSTUDY_NVP(c.width), {"pixels", {16, 4096}, "Width of a picture, of one eye"});
  a.Key(UNDERSTUDY_NVP(c.height), {"pixels", {16, 4096}, "Its height"});
  a.Key(UNDERSTUDY_NVP(c.focal), {"pixels", {1, 1e5}, "Focal length, across and down"});
  a.Key(UNDERSTUDY_NVP(c.centre), {"pixels", {-1e4, 1e4}, "Where its axis is in the picture"});
  a.Key(UNDERSTUDY_NVP(c.distortion), {"", {-10, 10}, "Distortion k1, k2, p1, p2, as OpenCV's"});
  a.Key(UNDERSTUDY_NVP(c.quality), {"", {1, 100}, "Quality of its JPEGs"});
  a.Key(UNDERSTUDY_NVP(c.depth),
        {"m", {0, 65}, "The nearest and the farthest depth that it measures; 0, 0 is none"});
  a.Key(UNDERSTUDY_NVP(c.video_port),
        {"", {0, 65535}, "UDP port at 230.1.1.1 of its video stream; 0 is none"});
  a.Key(UNDERSTUDY_NVP(c.video_topic),
        {"Topic with the same stream as Go2FrontVideoData_; \"\" is none"});
  a.Key(UNDERSTUDY_NVP(c.video_hz), {"Hz", {0.1, 60}, "Frames per second of both"});
}

void DescribeBattery(Archive& a, robot::BatterySpec& b) {
  a.Key(UNDERSTUDY_NVP(b.cells), {"", {0, 40}, "Cells in series"});
  a.Key(UNDERSTUDY_NVP(b.capacity_ah), {"A·h", kNotNegative, "Capacity"});
  a.Key(UNDERSTUDY_NVP(b.start_soc), {"", {0, 1}, "State of charge at the start, 1 is full"});
  a.Key(UNDERSTUDY_NVP(b.cell_v),
        {"V", {0.5, 5}, "Voltage of an unloaded cell at charges of 0, 0.1 ... 1, rising"});
  a.Key(UNDERSTUDY_NVP(b.internal_ohm), {"ohm", kNotNegative, "Resistance of the pack"});
  a.Key(UNDERSTUDY_NVP(b.idle_a), {"A", kNotNegative, "Current with all motors passive"});
  a.Key(UNDERSTUDY_NVP(b.most_a),
        {"A", kNotNegative, "Most that it gives: beyond it all motors give less; 0 is any"});
  a.Key(UNDERSTUDY_NVP(b.cutoff_a),
        {"A", kNotNegative, "Mean over cutoff_time beyond which it cuts off; 0 is never"});
  a.Key(UNDERSTUDY_NVP(b.cutoff_v),
        {"V", {0, 5}, "The same, below which its weakest cell cuts it off; 0 is never"});
  a.Key(UNDERSTUDY_NVP(b.cutoff_time), {"s", {0.001, 3600}, "Time constant of these means"});
  a.Key(UNDERSTUDY_NVP(b.low_soc), {"", {0, 1}, "Charge below which it is reported as low"});
  a.Key(UNDERSTUDY_NVP(b.cell_spread),
        {"V",
         {0, 0.1},
         "Standard deviation of the cells, by sensors.seed; unless it is 0, the end cells are 3 to "
         "13 mV lower besides"});
  a.Key(UNDERSTUDY_NVP(b.rise_per_w_c),
        {"°C/W", kNotNegative, "Steady rise over the air per loss in its resistance"});
  a.Key(UNDERSTUDY_NVP(b.time_constant), {"s", {1, 1e6}, "Time constant of that rise"});
}

void DescribeBoot(Archive& a, robot::BootSpec& b) {
  constexpr Range kBoot{0, 600};
  a.Key(UNDERSTUDY_NVP(b.states), {"s", kBoot, "Until states are sent and commands read"});
  a.Key(UNDERSTUDY_NVP(b.services),
        {"s", kBoot, "Until the first service answers; then they come one after the other"});
  a.Key(UNDERSTUDY_NVP(b.motion),
        {"s", kBoot, "Until all services answer and the motion service starts"});
}

}  // namespace

void Describe(Archive& a, robot::RobotSpec& r) {
  a.Key(UNDERSTUDY_NVP(r.name), {"Short name"});
  a.Key(UNDERSTUDY_NVP(r.description), {"What it is, in a line"});
  a.Key(UNDERSTUDY_NVP(r.model),
        {"Model file: absolute, relative to the YAML that names it, or below models"});
  a.Key(UNDERSTUDY_NVP(r.base_body), {"Body of the model that moves freely"});
  a.Choice(UNDERSTUDY_NVP(r.kind),
           {"Build: four legs, four legs with wheels, or two legs and two arms; for other, the "
            "motion service only damps"},
           {"other", "quadruped", "wheeled", "humanoid"});
  a.Choice(UNDERSTUDY_NVP(r.family), {"Message family on rt/lowcmd and rt/lowstate"}, {"go", "hg"});
  a.Key(UNDERSTUDY_NVP(r.firmware),
        {"Version of the robot's software that is simulated; of those that the robot's file lists "
         "under robot.firmwares the newest that it reaches sets what differs"});
  a.Key(UNDERSTUDY_NVP(r.state_id_since),
        {"First firmware that publishes the state machine's id: go in error_code of "
         "SportModeState, hg on rt/sportmodestate; \"\" is none"});
  a.Key(UNDERSTUDY_NVP(r.mode_machine),
        {"", {0, 255}, "Robot type that an hg robot publishes and that commands must repeat"});
  a.Key(UNDERSTUDY_NVP(r.revision),
        {"Hardware revision, one of those that the robot's file lists under robot.revisions; \"\" "
         "is none"});
  a.Key(UNDERSTUDY_NVP(r.locked_joints),
        {"Joints that cannot move: their motors are removed from robot.motors and from every pose, "
         "and the model fixes the joints"});
  a.List(UNDERSTUDY_NVP(r.bodies), {"Bodies that differ from the model file"}, DescribeBody,
         &robot::BodySpec::name);
  a.List(UNDERSTUDY_NVP(r.sites), {"Sites that differ from the model file"}, DescribeSite,
         &robot::SiteSpec::name);
  a.List(UNDERSTUDY_NVP(r.motor_types), {"Makes of motor; config/motors.yaml has the first list"},
         DescribeMotorType, &robot::MotorTypeSpec::name);
  a.List(UNDERSTUDY_NVP(r.motors), {"Motors of the body in motor order, which is ascending slot"},
         DescribeMotor, &robot::MotorSpec::joint);
  a.List(UNDERSTUDY_NVP(r.parallel), {"Pairs of joints that two parallel motors drive together"},
         DescribeParallel);
  a.Section(UNDERSTUDY_NVP(r.dynamics), {"Friction, damping and inertia of joints; drives"},
            DescribeDynamics, "use");
  a.List(UNDERSTUDY_NVP(r.buses),
         {"Buses between its computer and motors of the body; the others share one without a name, "
          "each hand has one of its own"},
         DescribeBus, &robot::BusSpec::name);
  a.List(UNDERSTUDY_NVP(r.fans), {"Fans in LowState; go only"}, DescribeFan, &robot::FanSpec::name);
  a.Section(UNDERSTUDY_NVP(r.board), {"The mainboard, as LowState of go shows it"}, DescribeBoard);
  a.Key(UNDERSTUDY_NVP(r.hand_makes), {"Hands that it can bear: names of config/hands"});
  a.Key(UNDERSTUDY_NVP(r.hand_make),
        {"Hands that it bears: one of hand_makes on both sides, left:NAME or right:NAME on one, "
         "both after a comma for different ones; or none. Sets robot.hands"});
  a.List(UNDERSTUDY_NVP(r.hands), {"Hands with motors and topics; hg only"}, DescribeHand);
  a.Section(UNDERSTUDY_NVP(r.imu), {"Inertial units"}, DescribeImu);
  a.Section(UNDERSTUDY_NVP(r.encoder_noise),
            {"Noise of motor readings, in steps of the motor's lattice"}, DescribeEncoderNoise);
  a.List(UNDERSTUDY_NVP(r.feet), {"Feet, in the order of foot_force"}, DescribeFoot,
         &robot::FootSpec::name);
  a.Section(UNDERSTUDY_NVP(r.foot_sensor), {"What foot_force shows"}, DescribeFootSensor);
  a.Section(UNDERSTUDY_NVP(r.lidar), {"The lidar of rt/utlidar (docs/seeing.md)"}, DescribeLidar);
  a.List(UNDERSTUDY_NVP(r.cameras), {"Cameras whose pictures services give (docs/seeing.md)"},
         DescribeCamera, &robot::CameraSpec::name);
  a.Section(UNDERSTUDY_NVP(r.rates), {"How often topics are written"}, DescribeRates);
  a.List(UNDERSTUDY_NVP(r.services),
         {"Programs on the robot's computer, as robot_state lists them"}, DescribeService,
         &robot::ServiceSpec::name);
  a.Key(UNDERSTUDY_NVP(r.apis),
        {"Services that answer requests: names of the tables in docs/reference/services.md"});
  a.Key(UNDERSTUDY_NVP(r.status_texts),
        {"Topics on which programs of the robot publish texts of their own accord"});
  a.Key(UNDERSTUDY_NVP(r.error_list),
        {"Whether rt/errorlist reports faults when they come and go; go only"});
  a.Key(UNDERSTUDY_NVP(r.arm_action_state), {"Whether rt/arm/action/state is written; hg only"});
  a.Section(UNDERSTUDY_NVP(r.arm_sdk), {"rt/arm_sdk: commands mixed over the motion service's"},
            DescribeArmSdk);
  a.Key(UNDERSTUDY_NVP(r.hand_sdk_timeout),
        {"s",
         {0, 3600},
         "Age at which a command of rt/hand_sdk expires; 0 is never (the default is assumed)"});
  a.Key(UNDERSTUDY_NVP(r.user_lowcmd),
        {"Whether the motion service can hand the motors to rt/user_lowcmd"});
  a.Section(UNDERSTUDY_NVP(r.remote), {"The remote controller"}, DescribeRemote);
  a.Section(UNDERSTUDY_NVP(r.battery), {"The battery"}, DescribeBattery);
  a.Section(UNDERSTUDY_NVP(r.boot), {"How long it boots after the power switch"}, DescribeBoot);
  a.Section(UNDERSTUDY_NVP(r.thermal), {"How warm motors may get"}, DescribeThermal);
  a.Section(UNDERSTUDY_NVP(r.lying), {"Pose on the ground, passive"}, DescribePose);
  a.Section(UNDERSTUDY_NVP(r.standing), {"Pose of standing"}, DescribePose);
  a.Section(UNDERSTUDY_NVP(r.hanging), {"Pose on the crane or clamped"}, DescribePose);
  a.Section(UNDERSTUDY_NVP(r.motion), {"The robot's motion service"}, DescribeMotionService);
  a.Key(UNDERSTUDY_NVP(r.crane_body), {"Body of the model to which the crane's hook is fixed"});
  a.Key(UNDERSTUDY_NVP(r.crane_point), {"m", {-5, 5}, "The hook in that body's frame"});
  a.Word(
      UNDERSTUDY_NVP(r.default_start),
      {"Pose a run starts in unless start.pose says otherwise; a quadruped that would stand lies "
       "where no motion service is on"},
      StartPoses());
}

}  // namespace understudy::config
