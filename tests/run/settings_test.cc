// No setting is without effect: for each a robot is played twice, once with the setting changed,
// and what it says on the bus differs.
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "assembly/make_world.h"
#include "base/errors.h"
#include "bus/cdr.h"
#include "bus/discovery.h"
#include "bus/writer.h"
#include "config/load.h"
#include "config/reference.h"
#include "emulator/live_settings.h"
#include "emulator/world.h"
#include "idl/type_table.h"
#include "schema/yaml_document.h"
#include "script/script.h"
#include "server/status_json.h"
#include "services/robot_services.h"
#include "services/service_host.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/new_domain.h"
#include "tests/support/temporary_folder.h"
#include "wire/message_crc.h"
#include "wire/port.h"
#include "wire/topics.h"

namespace understudy::run {
namespace {

using Settings = std::vector<std::string>;
using schema::YamlValue;
using testing::HasSubstr;

// A robot on a bus of its own, with all that a run has but the wall clock and the control socket.
class Played {
 public:
  explicit Played(config::Config config)
      : config_(std::move(config)),
        made_(assembly::MakePhysics(&config_)),
        port_(participant_, config_.robots[0].spec, config_.physics.timestep),
        host_(
            participant_, &port_.outlets(), services::ServicesOf(config_.robots[0].spec.apis),
            [](const std::string&) {}, config_.robots[0].spec.status_texts),
        world_(assembly::MakeWorld(
            std::move(made_.world), config_,
            [this](std::size_t) {
              return emulator::Ports{&port_, &host_};
            },
            &inbox_)) {
    for (const bus::TopicOnBus& topic : bus::EndpointWatch(participant_).Poll()) {
      if (const MessageType* type = FindMessageType(topic.type)) {
        heard_.try_emplace(topic, participant_, topic.topic, *type->descriptor);
      }
    }
  }

  emulator::World& world() { return *world_; }
  emulator::Inbox& inbox() { return inbox_; }
  int ms() const { return static_cast<int>(std::lround(world_->time() * 1000)); }

  template <class Msg>
  void Send(const bus::Topic<Msg>& topic, const Msg& message) {
    auto& writer = writers_[topic.name];
    if (!writer) writer = std::make_shared<bus::Writer<Msg>>(participant_, topic);
    ASSERT_TRUE(std::static_pointer_cast<bus::Writer<Msg>>(writer)->Write(message));
  }

  // All messages since the start, and the status.
  std::string Said() {
    std::string said = server::StatusJson({}, world_->status(0)).dump();
    for (auto& [topic, reader] : heard_) {
      said += topic.topic + topic.type;
      reader.Take([&](const bus::CdrSample& sample) {
        said.append(reinterpret_cast<const char*>(sample.bytes().data()), sample.bytes().size());
      });
    }
    return said;
  }

  std::string Model() const {
    const mjModel& model = world_->physics().model();
    std::string bytes(static_cast<std::size_t>(mj_sizeModel(&model)), '\0');
    mj_saveModel(&model, nullptr, bytes.data(), static_cast<int>(bytes.size()));
    return bytes;
  }

 private:
  config::Config config_;
  bus::Participant participant_{"lo", Domain()};
  assembly::MadePhysics made_;
  wire::Port port_;
  services::ServiceHost host_;
  emulator::Inbox inbox_;
  std::unique_ptr<emulator::World> world_;
  std::map<bus::TopicOnBus, bus::CdrReader> heard_;
  std::map<std::string, std::shared_ptr<void>> writers_;

  static int Domain() {
    static const int domain = test::NewDomain();
    return domain;
  }
};

using Acts = std::function<void(Played*)>;  // before every tick

// Commands, 200 a second, that `fill` is given to fill in.
template <class Msg>
Acts Sends(const bus::Topic<Msg>& topic, int until_ms, std::function<void(Msg*)> fill) {
  return [=](Played* played) {
    if (played->ms() % 5 != 0 || played->ms() >= until_ms) return;
    Msg message{};
    for (auto& motor : message.motor_cmd) motor.mode = 1;
    fill(&message);
    message.crc = wire::MessageCrc(message);
    played->Send(topic, message);
  };
}

using GoCmd = unitree_go_msg_dds__LowCmd_;
using HgCmd = unitree_hg_msg_dds__LowCmd_;

// A Go2 whose first hip is pushed to its stop.
Acts PushesHip(std::uint8_t head) {
  return Sends<GoCmd>(wire::kGoLowCmd, 400, [=](GoCmd* message) {
    message->head[0] = head;
    message->head[1] = 0xEF;
    message->level_flag = 0xFF;
    message->motor_cmd[0].tau = 20;
  });
}

// A G1 whose knee and ankle, its motors A and B, are asked for certain places.
Acts MovesAnkle() {
  return Sends<HgCmd>(wire::kHgLowCmd, 1000, [](HgCmd* message) {
    message->mode_machine = 5;
    message->mode_pr = 1;
    for (const auto& [slot, q] : std::map<int, float>{{3, 0.5F}, {4, 0.3F}, {5, -0.3F}}) {
      message->motor_cmd[slot].kp = 100;
      message->motor_cmd[slot].kd = 4;
      message->motor_cmd[slot].q = q;
    }
  });
}

// A G1 whose elbow is asked to go to -0.5 rad, half with the motion service where weights count.
Acts MovesElbow(const bus::Topic<HgCmd>& topic) {
  return Sends<HgCmd>(topic, 400, [](HgCmd* message) {
    message->motor_cmd[29].q = 0.5;
    message->motor_cmd[18].q = -0.5;
    message->motor_cmd[18].kp = 60;
    message->motor_cmd[18].kd = 2;
  });
}

// A left hand opens and, being watched, closes, is locked in between, is pressed by all terms of
// the motor law, and is left alone at last.
void UsesHand(Played* played) {
  static const bus::Topic<unitree_hg_msg_dds__HandCmd_> kTopic{"rt/dex3/left/cmd",
                                                               &unitree_hg_msg_dds__HandCmd__desc};
  const int ms = played->ms();
  if (ms % 5 != 0 || ms >= 600) return;
  std::array<unitree_hg_msg_dds__MotorCmd_, 7> motors{};
  const bool locked = ms >= 320 && ms < 400;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    motors[i].mode = static_cast<std::uint8_t>(i | (locked ? 0U : 1U << 4U) | 1U << 7U);
    motors[i].tau = ms < 200 ? 1 : -1;
    if (ms < 400) continue;
    motors[i].kp = 0.5;
    motors[i].q = -2.57F;
    motors[i].kd = 0.1F;
    motors[i].dq = -4;
  }
  unitree_hg_msg_dds__HandCmd_ message{};
  message.motor_cmd = {._maximum = 7, ._length = 7, ._buffer = motors.data(), ._release = false};
  played->Send(kTopic, message);
}

// Opens a left gripper by one message of rt/hand_sdk, with half a weight.
void OpensGripper(Played* played) {
  if (played->ms() != 100) return;
  std::array<unitree_go_msg_dds__MotorCmd_, 4> motors{};
  motors[0].mode = 50;
  motors[0].tau = -0.3F;
  played->Send(
      wire::kHandSdk,
      unitree_go_msg_dds__MotorCmds_{
          .cmds = {._maximum = 4, ._length = 4, ._buffer = motors.data(), ._release = false}});
}

// Once, what services there are.
void AsksForServices(Played* played) {
  static const bus::Topic<unitree_api_msg_dds__Request_> kTopic{
      "rt/api/robot_state/request", &unitree_api_msg_dds__Request__desc};
  if (played->ms() != 100) return;
  std::string parameter = "{}";
  unitree_api_msg_dds__Request_ message{};
  message.header.identity = {.id = 1, .api_id = 1003};
  message.parameter = parameter.data();
  played->Send(kTopic, message);
}

const std::map<std::string, Acts>& NamedActs() {
  static const std::map<std::string, Acts> acts = {
      {"", [](Played*) {}},
      {"push a hip", PushesHip(0xFE)},
      {"push a hip with a wrong head", PushesHip(1)},
      {"move an ankle", MovesAnkle()},
      {"move an elbow by arm_sdk", MovesElbow(wire::kHgArmSdk)},
      {"move an elbow by user_lowcmd", MovesElbow(wire::kUserLowCmd)},
      {"use a hand", UsesHand},
      {"open a gripper by hand_sdk", OpensGripper},
      {"ask for services", AsksForServices},
  };
  return acts;
}

const YamlValue& Rows() {
  static const YamlValue rows =
      schema::ReadYamlFile(UNDERSTUDY_SOURCE_DIR "/tests/run/data/settings.yaml");
  return rows;
}
const std::vector<YamlValue>& Scenes() { return Rows().Find("scenes")->items; }

class SettingsTest : public test::MujocoTest {
 protected:
  SettingsTest() {
    images_.Write("up.pgm", "P5 3 3 255\nAFKPUZ_di");
    images_.Write("down.pgm", "P5 3 3 255\nid_ZUPKFA");
  }

  // The value of a scene's key.
  static std::string Text(const YamlValue& scene, const char* key, const char* otherwise) {
    const YamlValue* const value = scene.Find(key);
    return value == nullptr ? otherwise : value->text;
  }
  // The texts of a list, or the text alone.
  static Settings Texts(const YamlValue& value) {
    if (value.kind == YamlValue::Kind::kScalar) return {value.text};
    Settings texts;
    for (const YamlValue& item : value.items) texts.push_back(item.text);
    return texts;
  }

  // Calls visit(key, texts) with what stands under "changes" or "refuses".
  template <class Visit>
  static void Each(const YamlValue& scene, const char* list, const Visit& visit) {
    const YamlValue* const map = scene.Find(list);
    for (std::size_t i = 0; map != nullptr && i < map->items.size(); ++i) {
      SCOPED_TRACE(map->keys[i].text);
      visit(map->keys[i].text, Texts(map->items[i]));
    }
  }
  static std::string SettingOf(const std::string& key, const std::string& text) {
    const std::size_t list = key.find("[]");
    if (list == std::string::npos) return key + "=" + text;
    const std::size_t dot = key.find('.');
    return dot < list ? key.substr(0, dot + 1) + text : text;
  }

  // What is said with these settings; throws SetupError.
  // `set` changes a setting just before the first step.
  std::string Said(const YamlValue& scene, const Settings& changed = {},
                   const nlohmann::json& set = nullptr) const {
    Settings sets = {"motion.service=none"};
    if (const YamlValue* given = scene.Find("given")) {
      for (const std::string& text : Texts(*given)) sets.push_back(text);
    }
    sets.insert(sets.end(), changed.begin(), changed.end());
    for (std::string& text : sets) {
      if (const auto at = text.find("IMAGES"); at != std::string::npos) {
        text.replace(at, 6, images_.path().string());
      }
    }
    Played played(config::LoadConfig(
        {.robot = Text(scene, "robot", "go2"), .files = {}, .sets = sets}, UNDERSTUDY_SOURCE_DIR));
    if (scene.Find("look") != nullptr) return played.Model();
    const std::string script = "script: [" + Text(scene, "script", "") + "]";
    script::Play(script::ReadScript(schema::ParseYaml(script, "script"), signals::RunningNames()),
                 &played.world());
    if (!set.is_null()) {
      played.inbox().Put(*emulator::ReadRequest("set", set));
    }
    const Acts& acts = NamedActs().at(Text(scene, "acts", ""));
    for (const int end = std::stoi(Text(scene, "ms", "300")); played.ms() < end;) {
      acts(&played);
      EXPECT_EQ(played.world().Tick(std::chrono::milliseconds(played.ms())),
                physics::StepHealth::kFine);
    }
    return played.Said();
  }

 private:
  const test::TemporaryFolder images_;
};

class SceneTest : public SettingsTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(SceneTest, IsChangedByEachSetting) {
  const YamlValue& scene = Scenes()[GetParam()];
  const std::string usual = Said(scene);
  EXPECT_TRUE(usual == Said(scene)) << scene.where << ": the same is not the same";
  Each(scene, "changes", [&](const std::string& key, Settings texts) {
    const std::string value = texts[0];
    for (std::string& text : texts) text = SettingOf(key, text);
    EXPECT_FALSE(usual == Said(scene, texts));
    if (scene.Find("look") != nullptr || texts.size() > 1 || !emulator::FindSetting(key)) return;
    EXPECT_FALSE(usual == Said(scene, {}, {{"key", key}, {"value", schema::JsonOfWord(value)}}))
        << "set while it runs";
  });
  Each(scene, "refuses", [&](const std::string& key, const Settings& texts) {
    EXPECT_THAT([&] { Said(scene, {SettingOf(key, texts[0])}); },
                testing::ThrowsMessage<SetupError>(HasSubstr(texts[1])));
  });
}

INSTANTIATE_TEST_SUITE_P(All, SceneTest, testing::Range(std::size_t{0}, Scenes().size()));

TEST_F(SettingsTest, HaveARowEach) {
  Settings keys;
  const auto add = [&keys](const std::string& key, const Settings&) { keys.push_back(key); };
  for (const YamlValue& scene : Scenes()) {
    Each(scene, "changes", add);
    Each(scene, "refuses", add);
  }
  const YamlValue& elsewhere = *Rows().Find("elsewhere");
  for (const YamlValue& file : elsewhere.keys) {
    std::stringstream test;
    test << std::ifstream(UNDERSTUDY_SOURCE_DIR "/tests/" + file.text).rdbuf();
    Each(elsewhere, file.text.c_str(), [&](const std::string& key, const Settings& words) {
      EXPECT_THAT(test.str(), HasSubstr(words[0]));
      add(key, {});
    });
  }
  EXPECT_THAT(keys, testing::UnorderedElementsAreArray(config::ConfigKeys()));
}

}  // namespace
}  // namespace understudy::run
