#include "config/keys.h"

#include "config/randomization_keys.h"
#include "robot/start_pose.h"

namespace understudy::config {
namespace {

void DescribeNetwork(Archive& a, NetworkConfig& c) {
  a.Key({"interface", "Network interface to speak on; lo stays on this machine"}, &c.interface);
  a.Key({"domain", "", {0, 232}, "DDS domain; robots and the vendor's programs use 0"}, &c.domain);
}

void DescribeGuard(Archive& a, GuardConfig& c) {
  a.Key({"listen_loopback",
         "s",
         {0, 10},
         "Wall time to listen for another robot on lo before the first word (the default is "
         "assumed)"},
        &c.listen_loopback);
  a.Key({"listen_network",
         "s",
         {0, 60},
         "The same on every other interface (the default is assumed)"},
        &c.listen_network);
  a.Choice({"on_stranger",
            "What to do when another robot speaks after we have started; warn also starts beside a "
            "writer of rt/lowstate that has not spoken"},
           {"silence", "warn", "stop"}, &c.on_stranger);
}

void DescribeControl(Archive& a, ControlConfig& c) {
  a.Key({"panel", "Serve the panel and all that ctl can do over TCP, for a browser"}, &c.panel);
  a.Key({"address",
         "IP address to serve it on; others than this machine's own can reach the robot "
         "on any but 127.0.0.1 and ::1"},
        &c.address);
  a.Key({"port",
         "",
         {0, 65535},
         "TCP port; 0 is the first that is free from 7707 on (which is assumed)"},
        &c.port);
}

void DescribeTime(Archive& a, TimeConfig& c) {
  a.Key({"speed", "s/s", {0, 1000}, "Simulated time per wall time; 0 is as fast as possible"},
        &c.speed);
  a.Key({"duration", "s", kNotNegative, "Simulated time after which the run ends; 0 is never"},
        &c.duration);
  a.Key({"realtime", "Ask for real-time scheduling and locked memory"}, &c.realtime);
}

void DescribePhysics(Archive& a, PhysicsConfig& c) {
  a.Key({"timestep",
         "s",
         {0.0001, 0.01},
         "Physics step and period of the motor law (the default is assumed)"},
        &c.timestep);
  a.Choice({"on_divergence", "What to do when the physics leaves all bounds"}, {"stop", "reset"},
           &c.on_divergence);
}

void DescribeSensors(Archive& a, sensors::SensorConfig& c) {
  a.Key({"quantise", "Round readings to the lattices of the real sensors"}, &c.quantise);
  a.Key({"noise", "Add the noise of the real sensors"}, &c.noise);
  a.Key({"seed", "", {0, kMaxInt}, "Seed of that noise"}, &c.seed);
}

void DescribeGate(Archive& a, authority::GateConfig& c) {
  a.Choice({"mode",
            "Whether a command that is wrong in form (crc, head, mode_machine, mode_pr, "
            "motor mode) is refused or counted and taken"},
           {"strict", "lenient"}, &c.lenient);
  a.Key({"timeout",
         "s",
         {0.001, 3600},
         "Simulated time without a taken command until the motors damp (the default is assumed: no "
         "figure is published)"},
        &c.timeout);
  a.Key({"damping_kd", "N·m·s/rad", {0, 100}, "Gain of that damping (the default is assumed)"},
        &c.damping_kd);
}

void DescribeMotion(Archive& a, authority::MotionConfig& c) {
  a.Key({"service",
         "Motion service that moves the robot at the start, by its alias in robot.services; none: "
         "rt/lowcmd does; \"\": the first that robot.firmware has"},
        &c.service);
  a.Key({"fight",
         "Follow rt/lowcmd although a motion service is on: motors do what either said last"},
        &c.fight);
}

void DescribeCrane(Archive& a, physics::CraneConfig& c) {
  a.Key({"length",
         "m",
         {0.05, 20},
         "Tether between anchor and hook at the start (the default is assumed)"},
        &c.length);
  a.Key({"stiffness", "N/m", {1, 1e6}, "Stiffness of the tether (the default is assumed)"},
        &c.stiffness);
  a.Key({"damping", "N·s/m", {0, 1e5}, "Damping of the tether while taut (the default is assumed)"},
        &c.damping);
  a.Key({"speed", "m/s", {0.001, 5}, "Speed of lowering and raising (the default is assumed)"},
        &c.speed);
}

void DescribeStart(Archive& a, StartConfig& c) {
  std::vector<std::string> words = StartPoses();
  words.insert(words.begin(), "");
  a.Word({"pose", "Pose the run starts in; \"\" is robot.default_start"}, words, &c.pose);
}

}  // namespace

const std::vector<std::string>& StartPoses() {
  static const std::vector<std::string> kPoses(robot::kStartPoses.begin(),
                                               robot::kStartPoses.end());
  return kPoses;
}

void Describe(Archive& a, Config& c) {
  DescribeScene(a, c);
  a.Section({"network", "Where to speak"}, [&] { DescribeNetwork(a, c.network); });
  a.Section({"guard", "Care for other robots on the network"}, [&] { DescribeGuard(a, c.guard); });
  a.Section({"control", "The panel's address"}, [&] { DescribeControl(a, c.control); });
  a.Section({"time", "How time passes"}, [&] { DescribeTime(a, c.time); });
  a.Section({"physics", "How physics is computed"}, [&] { DescribePhysics(a, c.physics); });
  a.Section({"sensors", "How readings differ from the truth"},
            [&] { DescribeSensors(a, c.sensors); });
  a.Section(
      {"gate", "Which commands the motors follow"}, [&] { DescribeGate(a, c.gate); }, "mode");
  a.Section(
      {"motion", "The robot's own motion service"}, [&] { DescribeMotion(a, c.motion); },
      "service");
  a.Section({"crane", "The tether a robot hangs from"}, [&] { DescribeCrane(a, c.crane); });
  a.Section({"start", "How a run begins"}, [&] { DescribeStart(a, c.start); });
  a.Section({"randomization",
             "What is drawn by chance at the start, each from [least, most]; [] leaves it "
             "(docs/randomization.md)"},
            [&] { DescribeRandomization(a, c.randomization); });
  a.Section({"robot", "What the robot is; config/robots holds one file per robot"},
            [&] { Describe(a, c.robot); });
}

}  // namespace understudy::config
