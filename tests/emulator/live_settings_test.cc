#include "emulator/live_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <mujoco/mujoco.h>

#include "config/keys.h"
#include "config/load.h"
#include "config/reference.h"
#include "schema/yaml_document.h"
#include "schema/yaml_reader.h"
#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::emulator {
namespace {

using nlohmann::json;

class LiveSettingsTest : public EmulatorTest {
 protected:
  LiveSettingsTest() { config_.robots[0].spec.imu.gyro_noise = 0.01; }

  std::string Set(const std::string& key, const json& value) {
    return Answered("set", {{"key", key}, {"value", value}});
  }
  const robot::RobotState& said() const { return port_.samples().back().state; }

  // What is said in some steps, with requests in the first of them.
  std::vector<std::string> Said(const std::vector<json>& sets) const {
    test::FakePort port;
    Inbox inbox;
    const auto world = Make(&port, &inbox);
    for (const json& values : sets) {
      inbox.Put(test::RequestOf("set", values));
    }
    for (int step = 0; step < 200; ++step) {
      EXPECT_EQ(world->Tick({}), physics::StepHealth::kFine);
    }
    std::vector<std::string> states;
    for (const test::FakePort::Sample& sample : port.samples()) {
      states.push_back(Bytes(sample.state));
    }
    return states;
  }
};

// Whether a configuration file may have it.
bool Reads(const std::string& key, const std::string& value) {
  config::Config config;
  schema::Places places;
  std::string text;
  std::string indent;
  std::size_t at = 0;
  for (std::size_t dot; (dot = key.find('.', at)) != std::string::npos; at = dot + 1) {
    text += indent + key.substr(at, dot - at) + ":\n";
    indent += "  ";
  }
  text += indent + key.substr(at) + ": " + value + "\n";
  try {
    const schema::YamlValue tree = schema::ParseYaml(text, "file");
    schema::YamlReader reader(tree, &places);
    config::Describe(reader, config);
    reader.Finish();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

TEST_F(LiveSettingsTest, AreEachAKeyOfTheConfigurationAndEveryOtherSaysWhyItIsNone) {
  const std::vector<std::string> keys = config::ConfigKeys();
  for (const LiveSetting& live : LiveSettings()) {
    EXPECT_TRUE(std::ranges::find(keys, live.key) != keys.end()) << live.key;
  }
  for (const std::string& key : keys) {
    const auto found = FindSetting(key);
    const bool fixed = std::ranges::any_of(FixedSettings(), [&](const FixedSetting& one) {
      return key.starts_with(one.begins) && found.why().find(one.why) != std::string::npos;
    });
    EXPECT_TRUE(found.ok() || fixed) << key << ": " << found.why();
  }
  for (const FixedSetting& fixed : FixedSettings()) {
    EXPECT_TRUE(std::ranges::any_of(keys, [&](const std::string& key) {
      return key.starts_with(fixed.begins) && !FindSetting(key);
    })) << fixed.begins;
  }
}

TEST_F(LiveSettingsTest, TakeWhatAConfigurationFileMayHaveAndNothingElse) {
  Start();
  int taken = 0, refused = 0;
  for (const schema::Entry& key : config::SettingKeys()) {
    std::vector<json> values = {true, false, 0, 1, -1, 1e9, "strict", "lenient", "stop", "zzz"};
    for (const double edge : {key.range.min, key.range.max}) {
      if (std::abs(edge) > 1e12) continue;
      values.insert(values.end(),
                    {edge, std::nextafter(edge, -1e300), std::nextafter(edge, 1e300)});
    }
    for (const json& value : values) {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      const bool reads = Reads(key.key, text);
      EXPECT_EQ(Set(key.key, value) == "", reads) << key.key << ": " << text;
      ++(reads ? taken : refused);
    }
  }
  EXPECT_GT(taken, 60);
  EXPECT_GT(refused, 100);
}

TEST_F(LiveSettingsTest, AllStandInTheConfigurationInEffect) {
  const auto number = [](const std::variant<bool*, double*>& at) {
    return std::visit([](auto* value) { return static_cast<double>(*value); }, at);
  };
  for (const LiveSetting& setting : LiveSettings()) {
    WorldSettings world = config::WorldSettingsOf(config_);
    RobotSettings robot = config::RobotSettingsOf(config_.robots[0]);
    std::visit([](auto* value) { *value = *value == 0; }, setting.at(world, robot));
    config::Config in_effect = config_;
    config::TakeSettings(world, &in_effect);
    config::TakeSettings(robot, &in_effect.robots[0]);
    WorldSettings world_again = config::WorldSettingsOf(in_effect);
    RobotSettings robot_again = config::RobotSettingsOf(in_effect.robots[0]);
    EXPECT_EQ(number(setting.at(world_again, robot_again)), number(setting.at(world, robot)))
        << setting.key;
  }
}

TEST_F(LiveSettingsTest, AreRefusedWithTheNearestKeyAndWithWhatIsExpected) {
  Start();
  const auto why = [](const char* key) {
    return ReadRequest("set", {{"key", key}, {"value", 1}}).why();
  };
  EXPECT_EQ(
      why("gate.timeot"),
      "key: expected a key that can change, got \"gate.timeot\"; did you mean 'gate.timeout'?");
  EXPECT_EQ(why("network.domain"),
            "key: expected a key that can change, got \"network.domain\": its sockets are open");
  EXPECT_EQ(Set("gate.timeout", 0), "gate.timeout: expected a number from 0.001 to 3600 s, got 0");
  EXPECT_EQ(Set("gate.mode", "lenent"),
            "gate.mode: expected one of strict, lenient, got \"lenent\"; did you mean 'lenient'?");
  EXPECT_THROW(
      world_->Play({{.at = 0,
                     .request = test::RequestOf("set", {{"key", "gate.timeout"}, {"value", -1}}),
                     .where = "s"}}),
      std::exception);
}

TEST_F(LiveSettingsTest, AreToldWhenTheyChangeAndListedWithTheirValues) {
  Start();
  EXPECT_EQ(Set("sensors.noise_gain", 3), "");
  EXPECT_EQ(Set("sensors.noise_gain", 3), "");
  EXPECT_EQ(Set("gate.mode", "lenient"), "");
  EXPECT_EQ(Set("terrain.friction", 0.5), "");
  EXPECT_EQ(
      Told(EventKind::kSetting),
      (std::vector<std::string>{"set sensors.noise_gain: 3, before 1", "set gate.mode: lenient",
                                "set terrain.friction: 0.5, before each patch's own"}));
  Snapshot snapshot = world_->MakeSnapshot(0);
  snapshot.parts = kPartSettings;
  world_->Show(&snapshot);
  for (std::size_t i = 0; i < snapshot.settings.size(); ++i) {
    const std::string& key = snapshot.setting_keys[i].key;
    if (key == "sensors.noise_gain") {
      EXPECT_EQ(snapshot.settings[i], 3);
    }
    if (key == "gate.mode") {
      const auto word = static_cast<std::size_t>(snapshot.settings[i]);
      EXPECT_EQ(snapshot.setting_keys[i].words.at(word), "lenient");
    }
    if (key == "gate.timeout") {
      EXPECT_EQ(snapshot.settings[i], config_.robots[0].gate.timeout);
    }
  }
}

// What was drawn is scaled: as if it had been so from the start, bit by bit.
TEST_F(LiveSettingsTest, AreAsIfTheyHadBeenSoFromTheStart) {
  const std::vector<std::string> before = Said({});
  const std::vector<std::string> live =
      Said({{{"key", "sensors.imu.gyro_bias"}, {"value", 0.1}},
            {{"key", "sensors.imu.accel_scale"}, {"value", 0.1}},
            {{"key", "sensors.imu.gyro_misalignment"}, {"value", 0.1}},
            {{"key", "sensors.foot.cross_talk"}, {"value", 0.1}},
            {{"key", "sensors.foot.scale"}, {"value", 0.1}},
            {{"key", "sensors.thermometer.offset_c"}, {"value", 2}},
            {{"key", "sensors.odometer.scale"}, {"value", 0.1}}});
  config_.robots[0].sensors.imu.gyro_bias = 0.1;
  config_.robots[0].sensors.imu.accel_scale = 0.1;
  config_.robots[0].sensors.imu.gyro_misalignment = 0.1;
  config_.robots[0].sensors.foot = {.scale = 0.1, .cross_talk = 0.1};
  config_.robots[0].sensors.thermometer.offset_c = 2;
  config_.robots[0].sensors.odometer.scale = 0.1;
  EXPECT_TRUE(live == Said({}));
  EXPECT_FALSE(live == before);
}

TEST_F(LiveSettingsTest, OfAScriptMakeEachRunTheSame) {
  const auto play = [this](double gain) {
    test::FakePort port;
    Inbox inbox;
    const auto world = Make(&port, &inbox);
    const auto set = [](double at, const char* key, const json& value) {
      return ScriptEvent{.at = at,
                         .request = test::RequestOf("set", {{"key", key}, {"value", value}})};
    };
    world->Play({set(0.02, "sensors.noise", true), set(0.05, "sensors.noise_gain", gain),
                 set(0.05, "sensors.imu.gyro_walk", 0.1), set(0.1, "terrain.friction", 0.1)});
    for (int step = 0; step < 200; ++step) {
      EXPECT_EQ(world->Tick({}), physics::StepHealth::kFine);
    }
    EXPECT_EQ(world->status(0).script_refused, 0);
    std::string states;
    for (const test::FakePort::Sample& sample : port.samples()) states += Bytes(sample.state);
    return states;
  };
  EXPECT_TRUE(play(3) == play(3));
  EXPECT_FALSE(play(3) == play(2));
}

TEST_F(LiveSettingsTest, OfTheGateHoldFromTheNextStepOn) {
  StartAs("standing");
  port_.Send(Torque(0));
  Tick(100);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
  EXPECT_EQ(Set("gate.timeout", 0.05), "");
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  port_.Send(Torque(0), robot::Refusal::kCrc);
  Tick();
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
  EXPECT_EQ(Set("gate.mode", "lenient"), "");
  port_.Send(Torque(0), robot::Refusal::kCrc);
  Tick();
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
}

TEST_F(LiveSettingsTest, HaveTheMotorsFollowCommandsBesideAMotionServiceOrNot) {
  config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
  config_.robots[0].motion.service = "ai";
  Start();
  Tick();
  ASSERT_EQ(world_->status(0).gate, authority::GateState::kClosed);
  EXPECT_EQ(Set("motion.fight", true), "");
  port_.Send(Torque(1));
  Tick();
  EXPECT_EQ(robot().command().motors[0].tau, 1);
  EXPECT_EQ(Set("motion.fight", "off"), "");
  port_.Send(Torque(1));
  Tick(20);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kClosed);
  EXPECT_EQ(robot().command().motors[0].tau, 0);
}

TEST_F(LiveSettingsTest, LowerTheCraneFasterWithoutMovingTheRobotThatHangs) {
  StartAs("hanging");
  Tick(2000);
  const double height = Height();
  EXPECT_EQ(Set("crane.damping", 3000), "");
  EXPECT_EQ(Set("crane.speed", 0.5), "");
  Tick(100);
  EXPECT_NEAR(Height(), height, 1e-6);
  Ask("crane.lower", 0.2);
  Tick(300);
  EXPECT_LT(Height(), height - 0.1);
}

TEST_F(LiveSettingsTest, MakeTheGroundSlippery) {
  const auto slid = [this](double friction) {
    StartAs("lying");
    Tick(500);
    EXPECT_EQ(Set("terrain.friction", friction), "");
    Ask("push", {{"force", {30, 0, 0}}, {"for", 0.3}});
    Tick(500);
    return world_->physics().robot().base().p_WB.x();
  };
  const double rough = slid(1), ice = slid(0.05);
  EXPECT_GT(ice, rough + 0.05);
  EXPECT_EQ(Set("terrain.friction", 0), "");
  const mjModel& model = world_->physics().model();
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] == 0) {
      EXPECT_GT(model.geom_friction[3 * geom], 0.1);
    }
  }
}

class JointTest : public EmulatorTest {
 protected:
  std::string Move(const std::string& joint, double angle, double seconds = 2) {
    return Answered("joint", {{"joint", joint}, {"angle", angle}, {"for", seconds}});
  }
  double Angle(std::size_t motor) const { return world_->physics().robot().q()[motor]; }
  std::string joint(std::size_t motor) const { return config_.robots[0].spec.motors[motor].joint; }
};

TEST_F(JointTest, GoesWhereItIsAskedToAtItsSpeedAndIsThenLetGo) {
  for (robot::MotorSpec& motor : config_.robots[0].spec.motors) {
    motor.hold_kp = 200;
    motor.hold_kd = 5;
  }
  StartAs("clamped");
  Tick(500);
  const double from = Angle(0), to = from + 0.3;
  EXPECT_EQ(Move(joint(0), to), "");
  Tick(150);
  EXPECT_LT(Angle(0), from + 0.2);
  Tick(850);
  EXPECT_NEAR(Angle(0), to, 0.03);
  EXPECT_EQ(robot().command().motors[0].kp, 200);
  EXPECT_NE(robot().command().motors[1].kp, 200);
  Tick(1000);
  EXPECT_EQ(robot().command().motors[0].kp, 0);
}

TEST_F(JointTest, IsRefusedWithTheNearestName) {
  StartAs("clamped");
  const std::string name = joint(0);
  EXPECT_NE(Move(name + "x", 0).find("; did you mean '" + name + "'?"), std::string::npos);
}

TEST_F(JointTest, IsLeftToAProgramAndToARobotThatIsFree) {
  StartAs("standing");
  EXPECT_EQ(Move(joint(0), 0), "the robot is not clamped; `clamp on` holds it");
  StartAs("clamped");
  EXPECT_EQ(Move(joint(0), 0.1), "");
  port_.Send(Torque(1));
  Tick(2);
  EXPECT_EQ(robot().command().motors[0].tau, 1);
  EXPECT_EQ(Move(joint(0), 0.1), "a program commands the motors");
  StartAs("clamped");
  EXPECT_EQ(Move(joint(0), 0.1), "");
  EXPECT_EQ(Answered("clamp", false), "");
  Tick();
  EXPECT_EQ(robot().command().motors[0].kp, 0);
}

}  // namespace
}  // namespace understudy::emulator
