#include "tests/bad_commands/rig.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include <gtest/gtest.h>

#include "assembly/make_world.h"
#include "bus/reader.h"
#include "tests/support/new_domain.h"
#include "wire/message_crc.h"
#include "wire/topics.h"

namespace understudy::bad_commands {
namespace {

const std::filesystem::path kRoot = UNDERSTUDY_SOURCE_DIR;

struct Go {
  using LowCmd = unitree_go_msg_dds__LowCmd_;
  using LowState = unitree_go_msg_dds__LowState_;
  static constexpr auto& kLowCmd = wire::kGoLowCmd;
  static constexpr auto& kLowState = wire::kGoLowState;
};
struct Hg {
  using LowCmd = unitree_hg_msg_dds__LowCmd_;
  using LowState = unitree_hg_msg_dds__LowState_;
  static constexpr auto& kLowCmd = wire::kHgLowCmd;
  static constexpr auto& kLowState = wire::kHgLowState;
};

template <class LowCmd>
LowCmd Encode(const Message& from) {
  LowCmd to{};
  if constexpr (requires { to.head; }) {
    std::ranges::copy(from.head, to.head);
    to.level_flag = from.level_flag;
    to.bms_cmd.off = from.rest;
    std::ranges::fill(to.wireless_remote, from.rest);
    std::ranges::fill(to.led, from.rest);
    std::ranges::fill(to.fan, from.rest);
    to.gpio = from.rest;
    to.reserve = from.rest;
  } else {
    to.mode_pr = from.mode_pr;
    to.mode_machine = from.mode_machine;
    std::ranges::fill(to.reserve, from.rest);
    for (auto& motor : to.motor_cmd) motor.reserve = from.rest;
  }
  for (std::size_t i = 0; i < std::min(std::size(to.motor_cmd), from.slots.size()); ++i) {
    auto& motor = to.motor_cmd[i];
    const Slot& slot = from.slots[i];
    motor.mode = slot.mode;
    motor.q = slot.q;
    motor.dq = slot.dq;
    motor.tau = slot.tau;
    motor.kp = slot.kp;
    motor.kd = slot.kd;
  }
  to.crc = wire::MessageCrc(to);
  if (from.crc == Message::Crc::kWrongBit) to.crc ^= 1U << 31;
  if (from.crc == Message::Crc::kZero) to.crc = 0;
  if (from.crc == Message::Crc::kOfAnotherMessage) to.motor_cmd[0].q += 1;
  return to;
}

template <class Family>
class FamilyWriter final : public Writer {
 public:
  FamilyWriter(const bus::Stranger& program, const WriterKind& kind)
      : publisher_(MakePublisher(program, kind), "create the program's publisher"),
        writer_(MakeWriter(program, kind), "create the program's writer") {}

  void Write(const Message& message) override {
    const typename Family::LowCmd command = Encode<typename Family::LowCmd>(message);
    ASSERT_EQ(dds_write(writer_.handle(), &command), DDS_RETCODE_OK);
  }

 private:
  static dds_entity_t MakePublisher(const bus::Stranger& program, const WriterKind& kind) {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                    &dds_delete_qos);
    if (kind.partition != nullptr) dds_qset_partition1(qos.get(), kind.partition);
    return dds_create_publisher(program.handle(), qos.get(), nullptr);
  }
  dds_entity_t MakeWriter(const bus::Stranger& program, const WriterKind& kind) const {
    const auto qos = bus::StrangerQos{.reliable = kind.reliable,
                                      .depth = kind.keep_all ? 0 : 1,
                                      .representation = kind.representation}
                         .Make();
    if (kind.transient_local) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    if (kind.exclusive) dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
    const dds_entity_t topic = dds_create_topic(program.handle(), Family::kLowCmd.descriptor,
                                                Family::kLowCmd.name, nullptr, nullptr);
    return dds_create_writer(publisher_.handle(), topic, qos.get(), nullptr);
  }

  bus::Entity publisher_;
  bus::Entity writer_;
};

template <class Family>
class FamilyListener final : public Listener {
 public:
  explicit FamilyListener(const bus::Participant& participant)
      : reader_(participant, Family::kLowState) {}

  void Listen() override {
    reader_.Take([this](const typename Family::LowState& state, bus::WriterHandle) {
      ++heard;
      for (const auto& motor : state.motor_state) {
        finite = finite && std::isfinite(motor.q) && std::isfinite(motor.dq) &&
                 std::isfinite(motor.tau_est);
      }
    });
  }

 private:
  bus::Reader<typename Family::LowState> reader_;
};

config::Config Clamped(const std::string& robot, bool service) {
  std::vector<std::string> sets = {"start.pose=clamped"};
  if (!service) sets.emplace_back("motion.service=none");
  return config::LoadConfig({.robot = robot, .sets = sets}, kRoot);
}

}  // namespace

Rig::Rig(const std::string& robot, bool service)
    : config_(Clamped(robot, service)),
      domain_(test::NewDomain()),
      alias_(test::NewDomain()),
      participant_("lo", domain_),
      port_(participant_, config_.robots[0].spec, config_.physics.timestep),
      stranger_(domain_),
      network_(bus::JoinOverTheNetwork(domain_, alias_)),
      host_(alias_),
      world_(assembly::MakeWorld(
          assembly::MakePhysics(&config_).world, config_,
          [this](std::size_t) { return emulator::Ports{&port_}; }, &inbox_)),
      ranges_(world_->physics().robot().ranges()),
      writer_(Join()) {
  if (is_go()) {
    listener_ = std::make_unique<FamilyListener<Go>>(participant_);
  } else {
    listener_ = std::make_unique<FamilyListener<Hg>>(participant_);
  }
}

void Rig::Restart() {
  world_->robot(0).Reset(robot::StartPose::kClamped);
  Tick(5);
  before_ = status();
  before_lowstates_ = listener_->heard;
  largest_torque_ = 0;
}

Message Rig::Reach(double by) const {
  Message message{.mode_machine = static_cast<std::uint8_t>(spec().mode_machine),
                  .slots = std::vector<Slot>(is_go() ? wire::kGoMotorSlots : wire::kHgMotorSlots)};
  const auto q = world_->physics().robot().q();
  for (std::size_t i = 0; i < spec().motors.size(); ++i) {
    const robot::MotorSpec& motor = spec().motors[i];
    message.slots[wire::SlotOf(motor)] = {.q = static_cast<float>(q[i] + by),
                                          .kp = static_cast<float>(motor.hold_kp),
                                          .kd = static_cast<float>(motor.hold_kd)};
  }
  return message;
}

std::unique_ptr<Writer> Rig::Join(const WriterKind& kind) {
  if (is_go()) return std::make_unique<FamilyWriter<Go>>(stranger_, kind);
  return std::make_unique<FamilyWriter<Hg>>(stranger_, kind);
}

std::unique_ptr<Writer> Rig::JoinAsOtherFamily() {
  // One participant has one type by a name of a topic.
  if (is_go()) return std::make_unique<FamilyWriter<Hg>>(host_, WriterKind{});
  return std::make_unique<FamilyWriter<Go>>(host_, WriterKind{});
}

void Rig::Tick(int ms) {
  for (int i = 0; i < ms; ++i) {
    ASSERT_EQ(world_->Tick({}), physics::StepHealth::kFine);
    const auto torque = world_->robot(0).torque();
    for (std::size_t m = 0; m < spec().motors.size(); ++m) {
      ASSERT_TRUE(std::isfinite(torque[m]));
      ASSERT_LE(std::abs(torque[m]), spec().motors[m].torque_limit * 1.0001);
    }
    largest_torque_ = std::max(largest_torque_, std::abs(torque[0]));
    listener_->Listen();
  }
  ASSERT_TRUE(listener_->finite);
}

std::uint64_t Rig::accepted() const {
  return status().commands.accepted - before_.commands.accepted;
}
std::uint64_t Rig::refused(robot::Refusal refusal) const {
  const auto index = static_cast<std::size_t>(refusal);
  return status().commands.refused[index] - before_.commands.refused[index];
}
std::uint64_t Rig::refused() const {
  const auto sum = [](const authority::GateCounts& counts) {
    return std::accumulate(counts.refused.begin(), counts.refused.end(), std::uint64_t{0});
  };
  return sum(status().commands) - sum(before_.commands);
}
std::uint64_t Rig::unused_slots() const {
  return status().port.unused_slots - before_.port.unused_slots;
}
std::uint64_t Rig::unset_heads() const {
  return status().port.unset_heads - before_.port.unset_heads;
}
std::uint64_t Rig::timeouts() const {
  return status().commands.timeouts - before_.commands.timeouts;
}

}  // namespace understudy::bad_commands
