// Two robots of different families in one world, each on a participant of its own.
#include <filesystem>
#include <optional>

#include <mujoco/mujoco.h>

#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "config/load.h"
#include "emulator/world.h"
#include "idl/unitree_api.h"
#include "physics/world_model.h"
#include "services/robot_services.h"
#include "services/service_host.h"
#include "tests/support/eventually.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/new_domain.h"
#include "tests/support/requests.h"
#include "tests/support/temporary_folder.h"
#include "wire/message_crc.h"
#include "wire/port.h"
#include "wire/topics.h"

namespace understudy::emulator {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

config::Config Clamped(const std::string& robot) {
  return config::LoadConfig({.robot = robot, .sets = {"start.pose=clamped"}}, kRoot);
}

// A robot with its ends of the bus, in a domain of its own.
struct Spoken {
  Spoken(const std::string& name, int domain)
      : config(Clamped(name)),
        participant("lo", domain),
        port(participant, config.robots[0].spec, config.physics.timestep),
        services(participant, &port.outlets(), services::ServicesOf(config.robots[0].spec.apis),
                 [](const std::string&) {}) {}

  RobotParts parts() {
    return {.spec = config.robots[0].spec,
            .settings = config::RobotSettingsOf(config.robots[0]),
            .ports = {.topics = &port, .services = &services}};
  }

  config::Config config;
  bus::Participant participant;
  wire::Port port;
  services::ServiceHost services;
};

// A user's program that speaks to a robot, through the robot's own participant: Cyclone has one of
// each domain in a process.
template <class LowCmd, class LowState>
struct Client {
  using Request = unitree_api_msg_dds__Request_;
  using Response = unitree_api_msg_dds__Response_;

  Client(const bus::Participant& participant, const bus::Topic<LowCmd>& lowcmd,
         const bus::Topic<LowState>& lowstate)
      : commands(participant, lowcmd),
        states(participant, lowstate),
        requests(participant,
                 {"rt/api/motion_switcher/request", &unitree_api_msg_dds__Request__desc}),
        responses(participant,
                  {"rt/api/motion_switcher/response", &unitree_api_msg_dds__Response__desc}) {}

  void ReleaseMode() {
    Request request{};
    request.header.identity = {.id = 7, .api_id = 1003};
    std::string parameter = "{}";
    request.parameter = parameter.data();
    ASSERT_TRUE(requests.Write(request));
  }
  // The motor of `slot` to `q`, all others free.
  void Reach(int slot, float q, std::uint8_t mode_machine = 0) {
    LowCmd command{};
    if constexpr (requires { command.head; }) {
      command.head[0] = 0xFE;
      command.head[1] = 0xEF;
      command.level_flag = 0xFF;
    } else {
      command.mode_machine = mode_machine;
    }
    for (auto& motor : command.motor_cmd) motor.mode = 1;
    command.motor_cmd[slot].q = q;
    command.motor_cmd[slot].kp = 60;
    command.motor_cmd[slot].kd = 2;
    command.crc = wire::MessageCrc(command);
    ASSERT_TRUE(commands.Write(command));
  }
  void Listen() {
    states.Take([this](const LowState& message, bus::WriterHandle) { state = message; });
    responses.Take([this](const Response& message, bus::WriterHandle) {
      if (message.header.identity.id == 7) code = message.header.status.code;
    });
  }

  bus::Writer<LowCmd> commands;
  bus::Reader<LowState> states;
  bus::Writer<Request> requests;
  bus::Reader<Response> responses;
  std::optional<LowState> state;
  std::optional<std::int32_t> code;
};

class TwoRobotsTest : public test::MujocoTest {
 protected:
  static constexpr int kGo2Hip = 0, kG1WaistYaw = 12;  // slots

  physics::MujocoWorld MakePhysics() {
    const auto placed = [](const Spoken& robot, const char* prefix, double x) {
      return physics::PlacedRobot{.spec = robot.config.robots[0].spec,
                                  .file = kRoot / "models" / robot.config.robots[0].spec.model,
                                  .prefix = prefix,
                                  .x = x};
    };
    const std::vector<physics::PlacedRobot> robots = {placed(go2_, "go2_", 0),
                                                      placed(g1_, "g1_", 2)};
    const auto scene = folder_.Write(
        "box.xml", "<mujoco><include file='" + (kRoot / "models/scene/flat.xml").string() +
                       "'/><worldbody><body name='box' pos='5 5 .1'><freejoint/>"
                       "<geom type='box' size='.1 .1 .1' mass='1'/></body></worldbody></mujoco>");
    return {physics::LoadWorldModel(robots, scene, 0.001), robots};
  }

  void Tick(int times) {
    for (int i = 0; i < times; ++i) {
      now_ += std::chrono::milliseconds(1);
      ASSERT_EQ(world_.Tick(now_), physics::StepHealth::kFine);
    }
    go2_client_.Listen();
    g1_client_.Listen();
  }
  // Ticks and says `again` until it is so.
  template <class Again, class So>
  ::testing::AssertionResult Until(Again again, So so) {
    if (test::Eventually([&] {
          again();
          Tick(20);
          return so();
        })) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "never";
  }

  test::TemporaryFolder folder_;
  Spoken go2_{"go2", test::NewDomain()};
  Spoken g1_{"g1", test::NewDomain()};
  Inbox inbox_;
  World world_{MakePhysics(), WorldSettings{}, {go2_.parts(), g1_.parts()}, &inbox_};
  time::Clock::Time now_{0};
  Client<unitree_go_msg_dds__LowCmd_, unitree_go_msg_dds__LowState_> go2_client_{
      go2_.participant, wire::kGoLowCmd, wire::kGoLowState};
  Client<unitree_hg_msg_dds__LowCmd_, unitree_hg_msg_dds__LowState_> g1_client_{
      g1_.participant, wire::kHgLowCmd, wire::kHgLowState};
};

TEST_F(TwoRobotsTest, AreEachSpokenToOnAParticipantOfItsOwn) {
  ASSERT_TRUE(Until([] {}, [&] { return go2_client_.state && g1_client_.state; }));

  // A call reaches the robot of its domain and not the other.
  ASSERT_TRUE(Until(
      [&] {
        if (!go2_client_.code) go2_client_.ReleaseMode();
      },
      [&] { return go2_client_.code.has_value(); }));
  EXPECT_EQ(go2_client_.code, 0);
  EXPECT_EQ(world_.robot(0).owner().active(), "");
  EXPECT_NE(world_.robot(1).owner().active(), "");
  ASSERT_TRUE(Until(
      [&] {
        if (!g1_client_.code) g1_client_.ReleaseMode();
      },
      [&] { return g1_client_.code.has_value(); }));
  EXPECT_EQ(g1_client_.code, 0);
  EXPECT_EQ(world_.robot(1).owner().active(), "");

  // So does a command.
  ASSERT_TRUE(
      Until([&] { go2_client_.Reach(kGo2Hip, 0.4F); },
            [&] { return std::abs(go2_client_.state->motor_state[kGo2Hip].q - 0.4) < 0.1; }));
  EXPECT_NEAR(g1_client_.state->motor_state[kG1WaistYaw].q, 0, 0.05);
  ASSERT_TRUE(Until(
      [&] {
        g1_client_.Reach(kG1WaistYaw, 0.5F,
                         static_cast<std::uint8_t>(g1_.config.robots[0].spec.mode_machine));
      },
      [&] { return std::abs(g1_client_.state->motor_state[kG1WaistYaw].q - 0.5) < 0.1; }));
}

TEST_F(TwoRobotsTest, AreResetOneByOne) {
  Tick(10);
  world_.robot(1).Reset(robot::StartPose::kStanding);
  Tick(1);
  EXPECT_TRUE(world_.physics().robot(0).clamped());
  EXPECT_FALSE(world_.physics().robot(1).clamped());
}

TEST_F(TwoRobotsTest, AreEachAskedByTheirNumberAndSayHowTheyAre) {
  const auto answered = [&](std::string_view name, const nlohmann::json& values) {
    auto asked = inbox_.Put(test::RequestOf(name, values));
    Tick(1);
    return asked->answer.get().why();
  };
  const auto clamped = [&](std::size_t robot) { return world_.status(robot).clamped; };
  const auto hangs = [&](std::size_t robot) { return world_.status(robot).crane_attached; };
  EXPECT_EQ(answered("crane.attach", {{"robot", 1}}), "");
  EXPECT_FALSE(hangs(0));
  EXPECT_TRUE(hangs(1));
  EXPECT_EQ(answered("clamp", {{"on", false}, {"robot", 1}}), "");
  EXPECT_TRUE(clamped(0));
  EXPECT_FALSE(clamped(1));
  EXPECT_EQ(answered("reset", {{"robot", 1}}), "");
  EXPECT_FALSE(hangs(1));
  EXPECT_TRUE(clamped(1));
  EXPECT_EQ(answered("push", {{"force", {0, 5, 0}}, {"robot", 1}}), "");
  EXPECT_EQ(world_.pushes(1)[0].body, world_.physics().robot(1).Body("pelvis"));
  EXPECT_EQ(answered("clamp", {{"on", false}, {"robot", 2}}), "robot: the world has no robot 2");
}

TEST_F(TwoRobotsTest, KeepTheForcesOnThemWhenTheOtherIsReset) {
  const auto ask = [&](std::string_view name, const nlohmann::json& values) {
    auto asked = inbox_.Put(test::RequestOf(name, values));
    Tick(1);
    EXPECT_TRUE(asked->answer.get());
  };
  ask("push", {{"force", {0, 5, 0}}, {"for", 60}, {"robot", 1}});
  ask("push", {{"force", {0, 5, 0}}, {"for", 60}});
  ask("drag", {{"body", "base_link"}, {"to", {0, 0, 1}}, {"for", 60}});
  // The other's, by its name in the world.
  ask("drag", {{"body", "g1_pelvis"}, {"to", {2, 0, 1}}, {"for", 60}});
  ask("reset", {{"robot", 0}});
  EXPECT_TRUE(world_.pushes(0).empty());
  EXPECT_TRUE(world_.drags(0).empty());
  EXPECT_EQ(world_.pushes(1).size(), 1U);
  EXPECT_EQ(world_.drags(1).size(), 1U);
  ask("let_go", {{"robot", 0}});
  EXPECT_EQ(world_.drags(1).size(), 1U);
  ask("let_go", {{"robot", 1}});
  EXPECT_TRUE(world_.drags(1).empty());
}

TEST_F(TwoRobotsTest, AreResetTogetherWithTheObjectsOfTheSceneOrOneAlone) {
  const auto ask = [&](std::string_view name, const nlohmann::json& values) {
    auto asked = inbox_.Put(test::RequestOf(name, values));
    Tick(1);
    return asked->answer.get().why();
  };
  const physics::MujocoWorld& physics = world_.physics();
  const int box = mj_name2id(&physics.model(), mjOBJ_BODY, "box");
  const auto place = [&] { return physics.data().xpos[3 * box]; };
  const auto clamped = [&](std::size_t robot) { return world_.status(robot).clamped; };
  for (const int robot : {0, 1}) EXPECT_EQ(ask("clamp", {{"on", false}, {"robot", robot}}), "");
  EXPECT_EQ(ask("push", {{"body", "box"}, {"force", {40, 0, 0}}, {"for", 0.1}}), "");
  Tick(600);
  const double pushed = place();
  ASSERT_GT(pushed, 5.2);

  EXPECT_EQ(ask("reset", {{"robot", 1}}), "");
  EXPECT_FALSE(clamped(0));
  EXPECT_TRUE(clamped(1));
  EXPECT_NEAR(place(), pushed, 0.05) << "the robots' world has it in common";

  EventRing::Reader events(&world_.events());
  for (Event event; events.Next(&event);) {
  }
  EXPECT_EQ(ask("reset", {{"all", true}}), "");
  EXPECT_TRUE(clamped(0));
  EXPECT_NEAR(place(), 5, 1e-3);
  std::vector<int> robots;
  for (Event event; events.Next(&event);) {
    if (event.kind == EventKind::kRequest) robots.push_back(event.robot);
  }
  EXPECT_EQ(robots, (std::vector<int>{0, 1})) << "the events of each robot have it";
}

TEST_F(TwoRobotsTest, AreEachSeenInASnapshotOfTheirWorld) {
  Tick(10);
  Snapshot go2 = world_.MakeSnapshot(0), g1 = world_.MakeSnapshot(1);
  for (Snapshot* snapshot : {&go2, &g1}) {
    snapshot->parts = kAllSnapshotParts;
    world_.Show(snapshot);
  }
  EXPECT_EQ(go2.motors.size(), 12U);
  EXPECT_EQ(g1.motors.size(), 29U);
  EXPECT_NEAR(go2.com[0], 0, 0.3);
  EXPECT_NEAR(g1.com[0], 2, 0.3);
  EXPECT_EQ(go2.bodies, g1.bodies);
}

}  // namespace
}  // namespace understudy::emulator
