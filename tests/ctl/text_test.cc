#include "ctl/text.h"

#include "emulator/events.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/status_json.h"

namespace understudy::ctl {
namespace {

using ::nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(const emulator::Status& status) {
  return StatusText(server::StatusJson({.robot = "g1", .version = "1.2.3", .pid = 42}, status));
}

TEST(CtlTextTest, StatusIsLinesOfLabelValueAndUnit) {
  emulator::Status status;
  status.loop.ready = true;
  status.time = 12.5;
  status.loop.pace.worst_lateness = 0.00025;
  status.crane_tension = 340.25;
  EXPECT_EQ(TextOf(status), R"(robot              g1
process            42
version            1.2.3
state              ready
simulated time     12.500  s
steps              0
speed wanted       1.000   x real time
paused             no
speed              0.000   x real time
lateness           0.000   ms
worst lateness     0.250   ms
late steps         0
time lost          0.000   s
states published   0
divergences        0
power              on
motion service     none
motors follow      nobody yet: the motors hold the start pose or brake
rt/lowcmd writers  0
commands taken     0
commands refused   0
command time-outs  0
unused motors set  0
service calls      0
calls refused      0
crane              released
crane length       0.000   m
crane tension      340.2   N
base clamped       no
base height        0.000   m
base tilt          0.000   rad
recording          off
randomized         no
)");
}

TEST(CtlTextTest, StatusHasTheForceOnEachHand) {
  emulator::Status status;
  emulator::CopyText("left", &status.hand_forces[0].name);
  status.hand_forces[0].force = 12.25;
  emulator::CopyText("right", &status.hand_forces[1].name);
  EXPECT_THAT(TextOf(status), HasSubstr("left hand force    12.2   N\n"
                                        "right hand force   0.0    N\n"
                                        "crane "));
}

TEST(CtlTextTest, ARobotThatBootsSaysHowLongItStillTakes) {
  emulator::Status status;
  status.power = robot::PowerState::kBooting;
  status.boots_for = 46.4;
  EXPECT_THAT(TextOf(status), HasSubstr("power              booting, 46 s to go\n"));
}

TEST(CtlTextTest, TheStatusHasTheFileThatIsRecordedTo) {
  emulator::Status status;
  status.loop.recording = {};
  status.loop.recording.state = emulator::RecordingState::kOn;
  status.loop.recording.bytes = 1'250'000;
  emulator::CopyText("/tmp/a.mcap", &status.loop.recording.file);
  EXPECT_THAT(TextOf(status), HasSubstr("recording          /tmp/a.mcap, 1.2 MB\n"));
  status.loop.recording.state = emulator::RecordingState::kFailed;
  EXPECT_THAT(TextOf(status), HasSubstr("recording          failed: /tmp/a.mcap\n"));
}

TEST(CtlTextTest, SaysWhyCommandsWereRefused) {
  emulator::Status status;
  status.commands.refused = {0, 2, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_THAT(TextOf(status), HasSubstr("3 (crc 2, gain 1)\n"));
}

TEST(CtlTextTest, SaysWhyCallsWereRefused) {
  emulator::Status status;
  status.services.requests = 9;
  status.services.refused[static_cast<std::size_t>(services::CallRefusal::kState)] = 3;
  EXPECT_THAT(TextOf(status), HasSubstr("3 (state 3)\n"));
}

TEST(CtlTextTest, NamesTheMotionServiceAndItsState) {
  emulator::Status status;
  status.motion_service = {'m', 'c', 'f'};
  status.motion.id = 1004;
  status.motion.name = "lying";
  EXPECT_THAT(TextOf(status), HasSubstr("motion service     mcf, lying (1004)\n"));
}

TEST(CtlTextTest, SaysFromWhichDangersTheMotionServiceProtectsTheRobot) {
  emulator::Status status;
  status.motion_service = {'m', 'c', 'f'};
  EXPECT_THAT(TextOf(status), Not(HasSubstr("protects")));
  for (const robot::Danger danger : {robot::Danger::kHeat, robot::Danger::kCharge}) {
    status.motion.dangers[static_cast<std::size_t>(danger)].does = robot::Protection::kStop;
  }
  EXPECT_THAT(TextOf(status), HasSubstr("protects from      heat, charge\n"));
}

TEST(CtlTextTest, SaysWhomTheMotorsFollow) {
  emulator::Status status;
  status.gate = authority::GateState::kFollowing;
  EXPECT_THAT(TextOf(status), HasSubstr("motors follow      LowCmd\n"));
  status.gate = authority::GateState::kDamping;
  EXPECT_THAT(TextOf(status), HasSubstr("nobody: the motors brake until the next LowCmd\n"));
  status.gate = authority::GateState::kLimp;
  EXPECT_THAT(TextOf(status), HasSubstr("nobody: the motors have no torque\n"));
  status.gate = authority::GateState::kClosed;
  EXPECT_THAT(TextOf(status), HasSubstr("motors follow      the motion service\n"));
}

TEST(CtlTextTest, NamesWhatProgramsWaitForInVain) {
  nlohmann::ordered_json status = server::StatusJson({.robot = "g1", .version = "", .pid = 0}, {});
  status["unserved"] = {{{"topic", "rt/gnss"}, {"text", "process 12 waits for rt/gnss, which"}}};
  EXPECT_THAT(StatusText(status),
              HasSubstr("nobody serves      process 12 waits for rt/gnss, which\n"));
}

TEST(CtlTextTest, SaysFromWhichSeedARobotIsRandomized) {
  nlohmann::ordered_json status = server::StatusJson({.robot = "g1", .version = "", .pid = 0}, {});
  status["randomization"] = {{"seed", 7}, {"drawn", {}}};
  EXPECT_THAT(StatusText(status), HasSubstr("randomized         from seed 7\n"));
}

TEST(CtlTextTest, SaysThatARobotWasSilenced) {
  emulator::Status status;
  status.loop.ready = true;
  status.silenced = true;
  EXPECT_THAT(TextOf(status), HasSubstr("silenced: another robot"));
}

TEST(CtlTextTest, SpeedZeroIsUnlimited) {
  emulator::Status status;
  status.speed = 0;
  EXPECT_THAT(TextOf(status), HasSubstr("unlimited"));
}

TEST(CtlTextTest, ANullIsADash) {
  nlohmann::ordered_json status = server::StatusJson({.robot = "g1", .version = "", .pid = 0}, {});
  status["base"]["tilt"] = nullptr;
  EXPECT_THAT(StatusText(status), HasSubstr("base tilt          -      rad\n"));
}

TEST(CtlTextTest, AStatusOfAnotherShapeThrows) {
  EXPECT_THROW(StatusText({{"robot", "g1"}}), nlohmann::json::exception);
}

TEST(CtlTextTest, FieldsAreLinesAndListsOfObjectsTables) {
  const auto object = nlohmann::ordered_json::parse(
      R"({"total": 3, "late": {"worst": 0.25, "ever": true, "at": null}, "bins": [1, 2],
          "refusals": [{"topic": "rt/lowcmd", "count": 2}, {"topic": "rt/x"}], "none": []})");
  EXPECT_EQ(FieldsText(object),
            "total       3\n"
            "late.worst  0.25\n"
            "late.ever   yes\n"
            "late.at     -\n"
            "bins        [1,2]\n"
            "none        []\n"
            "\n"
            "TOPIC      COUNT\n"
            "rt/lowcmd  2\n"
            "rt/x       -\n");
}

ordered_json SheetOfDamage() {
  return ordered_json::parse(R"({"damage": {"time": 12.5,
      "motors": [
        {"joint": "hip", "at_torque_limit": 0, "at_speed_limit": 0, "tripped": 0, "hottest": 31.5,
         "hardest_stop": 0, "largest_jump": 0.1, "mark": "ok"},
        {"joint": "calf", "at_torque_limit": 0.25, "at_speed_limit": 0, "tripped": 0,
         "hottest": 40, "hardest_stop": 0, "largest_jump": 0.2, "mark": "beyond"}],
      "limits": [
        {"figure": "shock", "limit": 39.25, "unit": "m/s²", "source": "derived: so", "reached": 35,
         "reached_unit": "m/s²", "held_against": 39.25, "motor": "", "mark": "near"},
        {"figure": "energy", "limit": 858200, "unit": "J", "source": "derived: so", "reached": 187,
         "reached_unit": "J", "held_against": 858200, "motor": "", "mark": "ok"},
        {"figure": "falls", "limit": 0, "unit": "", "source": "assumed: none", "reached": 0,
         "reached_unit": "", "held_against": 0, "motor": "", "mark": "ok"},
        {"figure": "at_torque_limit", "limit": null, "unit": "N·m", "source": "vendor: URDF",
         "reached": 0.25, "reached_unit": "s", "held_against": 45.43, "motor": "calf",
         "mark": "beyond"},
        {"figure": "at_speed_limit", "limit": null, "unit": "rad/s", "source": "vendor: URDF",
         "reached": 0, "reached_unit": "s", "held_against": null, "motor": "", "mark": "ok"},
        {"figure": "largest_jump", "limit": null, "unit": "rad", "source": "derived: so",
         "reached": 0.2, "reached_unit": "rad", "held_against": null, "motor": "calf",
         "mark": "ok"}]}})");
}

TEST(CtlTextTest, DamageIsATableOfFiguresWithLimitsAndMarksAndOfTheMotorsThatMatter) {
  EXPECT_EQ(DamageText(SheetOfDamage(), false),
            R"(FIGURE           REACHED  LIMIT                      MARK    MOTOR
shock            35 m/s²  39.25 m/s²                 near
energy           187 J    858.2 kJ                   ok
falls            0        0                          ok
at_torque_limit  0.25 s   0 s at 45.43 N·m           BEYOND  calf
at_speed_limit   0 s      0 s at each motor's limit  ok
largest_jump     0.2 rad  none known                 ok      calf

MOTOR  MARK    at_torque_limit [s]  at_speed_limit [s]  tripped [s]  hottest [°C]  hardest_stop [rad/s]  largest_jump [rad]
calf   BEYOND  0.25                 0                   0            40            0                     0.2

after 12.5 s: 1 figure is beyond its limit
)");
  EXPECT_EQ(BeyondCount(SheetOfDamage()), 1);
}

TEST(CtlTextTest, AllOfTheDamageHasEveryMotorAndTheSourcesOfTheLimits) {
  const std::string text = DamageText(SheetOfDamage(), true);
  EXPECT_THAT(text, HasSubstr("\nhip    ok      0 "));
  EXPECT_THAT(text, HasSubstr("vendor: URDF\n"));
}

TEST(CtlTextTest, ASheetWithoutDamageSaysSoAndHasNoMotors) {
  ordered_json sheet = SheetOfDamage();
  sheet["damage"]["motors"][1]["mark"] = "ok";
  sheet["damage"]["limits"][3]["mark"] = "ok";
  const std::string text = DamageText(sheet, false);
  EXPECT_THAT(text, HasSubstr("nothing is beyond its limit"));
  EXPECT_THAT(text, Not(HasSubstr("hottest")));
}

TEST(CtlTextTest, LateTicksAreOneLineAtTheLastOfThem) {
  const auto late = [](double time, int count, double worst) {
    return ordered_json{{"kind", "overrun"},
                        {"time", time},
                        {"text", "late"},
                        {"detail", {{"worst", worst}, {"count", count}}}};
  };
  const auto other = [](double time) {
    return ordered_json{
        {"kind", "fall"}, {"time", time}, {"text", "fell"}, {"detail", ordered_json::object()}};
  };
  EXPECT_EQ(EventsText({{"events", {late(1, 3, 0.002), other(2), late(3, 1, 0.009), other(4)}}}),
            "2.000 s  fell\n"
            "3.000 s  4 ticks began late since 1.0 s, the worst by 9.0 ms\n"
            "4.000 s  fell\n");
  EXPECT_EQ(EventsText({{"events", ordered_json::array({late(1, 1, 0.002)})}}),
            "1.000 s  1 tick began late since 1.0 s, the worst by 2.0 ms\n");
  EXPECT_EQ(EventsText({{"events", ordered_json::array()}}), "");
}

TEST(CtlTextTest, AUnitWithForeignLettersTakesThePlacesThatItShows) {
  EXPECT_EQ(Aligned({{"rad/s/√s", "x"}, {"m/s²", "x"}, {"N·s/m", "x"}}),
            "rad/s/√s  x\nm/s²      x\nN·s/m     x\n");
}

TEST(CtlTextTest, RobotsAreATable) {
  EXPECT_EQ(RobotsText({{.name = "left", .socket = "/r/left.sock", .pid = 7},
                        {.name = "g", .socket = "/r/g.sock", .pid = 0}}),
            "NAME  PROCESS  SOCKET\n"
            "left  7        /r/left.sock\n"
            "g     ?        /r/g.sock\n");
  EXPECT_EQ(RobotsText({}), "no robot runs\n");
}

}  // namespace
}  // namespace understudy::ctl
