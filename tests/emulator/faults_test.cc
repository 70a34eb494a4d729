// Every row of the table of faults: injected, seen in the published state, taken away, gone.
#include <cmath>
#include <map>
#include <ostream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "robot/fault.h"
#include "tests/emulator/emulator_test.h"

namespace understudy::robot {

void PrintTo(const FaultKind& kind, std::ostream* out) {
  *out << NameOf(kind.of) << " " << kind.name;
}

}  // namespace understudy::robot

namespace understudy::emulator {
namespace {

using robot::Component;
using robot::RobotState;

constexpr std::size_t kMotor = 1;

// Whether the state of a robot with the fault shows it, beside the state of the same robot without.
using Shows = bool (*)(const RobotState& faulty, const RobotState& fine);

const robot::MotorReading& Motor(const RobotState& state) { return state.motors[kMotor]; }
double Angle(const RobotState& state) { return Motor(state).q; }

bool ShowsNothing(const RobotState& faulty, const RobotState& fine) {
  return Motor(faulty).tau == Motor(fine).tau && !Motor(faulty).silent &&
         std::abs(Motor(faulty).winding_c - Motor(fine).winding_c) < 1 &&
         !Motor(faulty).encoder_error && std::abs(Angle(faulty) - Angle(fine)) < 1e-3 &&
         (faulty.imu.w_WI_I - fine.imu.w_WI_I).norm() < 1e-3 &&
         faulty.imu.R_WI.angularDistance(fine.imu.R_WI) < 1e-3 &&
         std::abs(faulty.foot_force[0] - fine.foot_force[0]) < 1 &&
         std::abs(faulty.board.centre_c - fine.board.centre_c) < 0.1 && faulty.board.stalled == 0 &&
         !faulty.board.mute && faulty.remote.there == fine.remote.there;
}

// A row without a line here fails the test.
const std::map<std::pair<Component, std::string_view>, Shows> kShown = {
    {{Component::kMotor, "limp"},
     [](const RobotState& faulty, const RobotState& fine) {
       return Motor(faulty).tau == 0 && Motor(fine).tau != 0;
     }},
    {{Component::kMotor, "off"},
     [](const RobotState& faulty, const RobotState&) {
       return Motor(faulty).silent && Motor(faulty).lost > 0;
     }},
    {{Component::kMotor, "weak"},
     [](const RobotState& faulty, const RobotState& fine) {
       return Motor(faulty).tau == Motor(fine).tau / 2;
     }},
    {{Component::kMotor, "jammed"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty)) < 0.01 && std::abs(Angle(fine)) > 0.1;
     }},
    {{Component::kMotor, "dragging"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty)) < 0.5 * std::abs(Angle(fine));
     }},
    {{Component::kMotor, "hot"},
     [](const RobotState& faulty, const RobotState& fine) {
       return Motor(faulty).winding_c > Motor(fine).winding_c + 50 &&
              Motor(faulty).casing_c > Motor(fine).casing_c + 40;
     }},
    {{Component::kEncoder, "off"},
     [](const RobotState& faulty, const RobotState&) {
       return Angle(faulty) == 0 && Motor(faulty).encoder_error;
     }},
    {{Component::kEncoder, "stuck"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty)) < 0.01 && Motor(faulty).dq == 0 && Angle(fine) > 0.1;
     }},
    {{Component::kEncoder, "garbage"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty) - Angle(fine)) > 0.01 && Motor(faulty).encoder_error;
     }},
    {{Component::kEncoder, "offset"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty) - Angle(fine) - 0.05) < 0.01;
     }},
    {{Component::kEncoder, "drifting"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty) - Angle(fine) - 0.002 * 0.2) < 1e-4;
     }},
    {{Component::kEncoder, "noisy"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(Angle(faulty) - Angle(fine)) > 1e-4;
     }},
    {{Component::kImu, "off"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.imu.f_WI_I.isZero(0) && fine.imu.f_WI_I.norm() > 5;
     }},
    {{Component::kImu, "stuck"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.imu.f_WI_I != fine.imu.f_WI_I;
     }},
    {{Component::kImu, "offset"},
     [](const RobotState& faulty, const RobotState& fine) {
       return (faulty.imu.w_WI_I - fine.imu.w_WI_I - Eigen::Vector3d::Constant(0.02)).norm() < 2e-3;
     }},
    {{Component::kImu, "tilted"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(faulty.imu.R_WI.angularDistance(fine.imu.R_WI) - 0.05) < 1e-6;
     }},
    {{Component::kImu, "drifting"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(faulty.imu.R_WI.angularDistance(fine.imu.R_WI) - 0.01 * 0.2) < 1e-4;
     }},
    {{Component::kImu, "noisy"},
     [](const RobotState& faulty, const RobotState& fine) {
       return (faulty.imu.w_WI_I - fine.imu.w_WI_I).norm() > 1e-3 &&
              (faulty.imu.f_WI_I - fine.imu.f_WI_I).norm() > 1e-2;
     }},
    {{Component::kFoot, "off"},
     [](const RobotState& faulty, const RobotState&) { return faulty.foot_force[0] == 0; }},
    {{Component::kFoot, "stuck"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.foot_force[0] != fine.foot_force[0];
     }},
    {{Component::kFoot, "weak"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.foot_force[0] == fine.foot_force[0] / 2;
     }},
    {{Component::kFoot, "offset"},
     [](const RobotState& faulty, const RobotState& fine) {
       return std::abs(faulty.foot_force[0] - fine.foot_force[0] - 20) < 1e-9;
     }},
    {{Component::kBattery, "weak"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.battery.voltage < fine.battery.voltage;
     }},
    {{Component::kBattery, "empty"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.battery.soc <= 0.05 && fine.battery.soc > 0.5 &&
              faulty.battery.voltage < fine.battery.voltage - 1;
     }},
    {{Component::kRemote, "off"},
     [](const RobotState& faulty, const RobotState& fine) {
       return !faulty.remote.there && fine.remote.there;
     }},
    {{Component::kBus, "off"},
     [](const RobotState& faulty, const RobotState&) {
       return Motor(faulty).silent && Motor(faulty).lost > 0;
     }},
    {{Component::kBus, "lost"},
     [](const RobotState& faulty, const RobotState&) {
       return !Motor(faulty).silent && Motor(faulty).lost > 0;
     }},
    {{Component::kFan, "off"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.board.centre_c > fine.board.centre_c + 1 && faulty.board.stalled == 4 &&
              faulty.board.fan_rpm[2] == 0 && fine.board.fan_rpm[2] == 3000;
     }},
    {{Component::kFan, "weak"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.board.charger_c > fine.board.charger_c + 0.5 && faulty.board.stalled == 0 &&
              faulty.board.fan_rpm[2] == 1500;
     }},
    {{Component::kMainboard, "off"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.tick_ms < fine.tick_ms;
     }},
    {{Component::kMainboard, "hot"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.board.centre_c == fine.board.centre_c + 30;
     }},
    {{Component::kMcu, "off"},
     [](const RobotState& faulty, const RobotState&) { return faulty.board.mute; }},
    {{Component::kTopic, "off"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.tick_ms < fine.tick_ms;
     }},
    {{Component::kTopic, "lost"},
     [](const RobotState& faulty, const RobotState& fine) {
       return faulty.tick_ms < fine.tick_ms;
     }},
};

// The same of what no state shows, but port and services are told.
using Tells = bool (*)(const robot::LinkEffects& link, const robot::ServiceEffects& service,
                       const robot::BusEffects& bus);
const std::map<std::pair<Component, std::string_view>, Tells> kTold = {
    {{Component::kTopic, "doubled"},
     [](const auto& link, const auto&, const auto&) { return link.doubles; }},
    {{Component::kTopic, "damaged"},
     [](const auto& link, const auto&, const auto&) { return link.damages; }},
    {{Component::kTopic, "reordered"},
     [](const auto& link, const auto&, const auto&) { return link.reorders; }},
    {{Component::kTopic, "delayed"},
     [](const auto& link, const auto&, const auto&) { return link.delay == 1; }},
    {{Component::kTopic, "jittery"},
     [](const auto& link, const auto&, const auto&) { return link.delay > 0; }},
    {{Component::kService, "off"},
     [](const auto&, const auto& service, const auto&) { return service.off; }},
    {{Component::kService, "slow"},
     [](const auto&, const auto& service, const auto&) { return service.delay == 1; }},
    {{Component::kBus, "slow"},
     [](const auto&, const auto&, const auto& bus) { return bus.delay == 0.01; }},
    {{Component::kBus, "jittery"},
     [](const auto&, const auto&, const auto& bus) { return bus.delay > 0; }},
};

// Two clamped robots that get the same commands; the second has the fault.
class FaultsTest : public EmulatorTest, public testing::WithParamInterface<robot::FaultKind> {
 protected:
  static constexpr int kTicks = 200;

  FaultsTest() {
    config_.robots[0].sensors.noise = false;
    config_.robots[0].start.pose = "clamped";
    // It stands on the ground, so that feet carry something too.
    config_.robots[0].spec.hanging.height = config_.robots[0].spec.standing.height;
    config_.robots[0].spec.buses = {
        {.name = "leg", .slots = {config_.robots[0].spec.motors[kMotor].slot}}};
    config_.robots[0].spec.fans = {{.name = "front", .place = 2, .rpm = 3000, .stall_bit = 4}};
    config_.robots[0].spec.board.time_constant = 0.02;
    Start();
    fine_ = Make(&fine_port_, &fine_inbox_);
    for (test::FakePort* port : {&port_, &fine_port_}) port->SendEveryTick(Torque(5));
    for (Inbox* inbox : {&inbox_, &fine_inbox_}) {
      inbox->Put(test::RequestOf("remote.on"));
    }
    TickBoth();
  }

  void TickBoth(int times = 1) {
    for (int i = 0; i < times; ++i) {
      Tick();
      ASSERT_EQ(fine_->Tick({}), physics::StepHealth::kFine);
    }
  }
  void AskBoth(const char* name) {
    Ask(name);
    fine_inbox_.Put(test::RequestOf(name));
  }

  const std::vector<robot::BusEffects>& buses() const { return robot().faults().effects().buses; }

  std::string ComponentName() const {
    const robot::RobotSpec& spec = config_.robots[0].spec;
    switch (GetParam().of) {
      case Component::kMotor:
        return spec.motors[kMotor].joint;
      case Component::kEncoder:
        return spec.motors[kMotor].joint + ".encoder";
      case Component::kImu:
        return "imu";
      case Component::kFoot:
        return "foot." + spec.feet[0].name;
      case Component::kBattery:
        return "battery";
      case Component::kRemote:
        return "remote";
      case Component::kTopic:
        return "rt/lowstate";
      case Component::kService:
        return "service.fake";
      case Component::kBus:
        return "bus.leg";
      case Component::kFan:
        return "fan.front";
      case Component::kMainboard:
        return "mainboard";
      case Component::kMcu:
        return "mcu";
      case Component::kLidar:   // lidar_test.cc
      case Component::kCamera:  // tests/run/cameras_test.cc
      case Component::kHand:    // hands_test.cc
        return "";
    }
    return "";
  }

  test::FakePort fine_port_;
  Inbox fine_inbox_;
  std::unique_ptr<World> fine_;
};

TEST_P(FaultsTest, IsSeenInWhatIsPublishedAndGoneOnceItIsTakenAway) {
  const auto shown = kShown.find({GetParam().of, GetParam().name});
  const auto told = kTold.find({GetParam().of, GetParam().name});
  ASSERT_TRUE(shown != kShown.end() || told != kTold.end()) << "say how one sees it: kShown";
  nlohmann::json fault{{"component", ComponentName()}, {"fault", GetParam().name}};
  // All messages, so that the last one tells.
  if (GetParam().of == Component::kTopic && GetParam().has_magnitude()) {
    fault["by"] = GetParam().high;
  }
  Ask("fault", fault);
  TickBoth(kTicks);
  if (shown != kShown.end()) {
    EXPECT_TRUE(shown->second(port_.last().state, fine_port_.last().state));
  } else {
    EXPECT_TRUE(told->second(port_.link(), services_.suffers(), buses()[0]));
  }

  Ask("fault", {{"component", ComponentName()}, {"fault", "none"}});
  AskBoth("reset");
  TickBoth(kTicks);
  EXPECT_TRUE(ShowsNothing(port_.last().state, fine_port_.last().state));
  // One that has booted counts its ticks from then on.
  if (GetParam().of != Component::kMainboard) {
    EXPECT_EQ(port_.last().state.tick_ms, fine_port_.last().state.tick_ms);
  }
  if (told != kTold.end()) {
    EXPECT_FALSE(told->second(port_.link(), services_.suffers(), buses()[0]));
  }
}

TEST_P(FaultsTest, IsToldAsItComesAndGoes) {
  Ask("fault", {{"component", ComponentName()}, {"fault", GetParam().name}, {"for", 0.05}});
  Tick(100);
  const std::vector<std::string> told = Told(EventKind::kFault);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].find(ComponentName() + " is " + std::string(GetParam().name)), 0U) << told[0];
  EXPECT_EQ(told[1], ComponentName() + " is no longer " + std::string(GetParam().name));
}

std::string Titled(const testing::TestParamInfo<robot::FaultKind>& info) {
  std::string title = std::to_string(info.index) + "_";
  for (const char c : std::string(info.param.name)) title += std::isalnum(c) != 0 ? c : '_';
  return title;
}

// A lidar's are in lidar_test.cc, a camera's in tests/run/cameras_test.cc, a hand's in
// hands_test.cc.
std::vector<robot::FaultKind> KindsOfStates() {
  std::vector<robot::FaultKind> kinds(robot::FaultKinds().begin(), robot::FaultKinds().end());
  std::erase_if(kinds, [](const robot::FaultKind& kind) {
    return kind.of == Component::kLidar || kind.of == Component::kCamera ||
           kind.of == Component::kHand;
  });
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, FaultsTest, testing::ValuesIn(KindsOfStates()), Titled);

}  // namespace
}  // namespace understudy::emulator
