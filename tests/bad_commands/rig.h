// A robot on the bus, clamped, and programs that send it LowCmd as no program should.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bus/participant.h"
#include "config/load.h"
#include "emulator/world.h"
#include "tests/bus/stranger.h"
#include "wire/port.h"

namespace understudy::bad_commands {

// A slot of a LowCmd of either family.
struct Slot {
  std::uint8_t mode = 1;
  float q = 0, dq = 0, tau = 0, kp = 0, kd = 0;  // rad, rad/s, N·m, N·m/rad, N·m·s/rad
};

// A LowCmd of either family; what the other one has not is not sent.
struct Message {
  std::array<std::uint8_t, 2> head{0xFE, 0xEF};  // go
  std::uint8_t level_flag = 0xFF;                // go
  std::uint8_t mode_pr = 0, mode_machine = 0;    // hg
  std::vector<Slot> slots;
  std::uint8_t rest = 0;  // every byte of led, fan, gpio, bms_cmd, wireless_remote, reserve
  enum class Crc { kRight, kWrongBit, kZero, kOfAnotherMessage } crc = Crc::kRight;
};

// How a program made its writer.
struct WriterKind {
  bool reliable = true, transient_local = false, keep_all = false, exclusive = false;
  dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  const char* partition = nullptr;
};

// A program's writer of rt/lowcmd.
class Writer {
 public:
  virtual ~Writer() = default;
  virtual void Write(const Message& message) = 0;
};

// What the robot has sent on rt/lowstate.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void Listen() = 0;
  int heard = 0;       // messages
  bool finite = true;  // every q, dq and tau_est of all of them
};

class Rig {
 public:
  // With `service` its own motion service moves the robot.
  explicit Rig(const std::string& robot, bool service = false);

  // The robot as at its start; counts are those from now on.
  void Restart();

  const robot::RobotSpec& spec() const { return config_.robots[0].spec; }
  bool is_go() const { return spec().family == robot::WireFamily::kGo; }

  // A command that has each motor at its angle and `by` rad further.
  Message Reach(double by) const;

  void Send(const Message& message) { writer_->Write(message); }
  // Another program's writer.
  std::unique_ptr<Writer> Join(const WriterKind& kind = {});
  // A writer of the other family's LowCmd on the same topic.
  std::unique_ptr<Writer> JoinAsOtherFamily();
  const bus::Participant& participant() const { return participant_; }
  const bus::Stranger& stranger() const { return stranger_; }  // in the robot's domain
  const bus::Stranger& host() const { return host_; }          // speaks over the network

  // Lets so many ms pass. In each the physics must go well, torques be within the motors' limits
  // and what is told be finite.
  void Tick(int ms);

  std::uint64_t accepted() const;
  std::uint64_t refused(robot::Refusal refusal) const;
  std::uint64_t refused() const;  // for any reason
  std::uint64_t unused_slots() const;
  std::uint64_t unset_heads() const;
  std::uint64_t timeouts() const;
  int lowstates() const { return listener_->heard - before_lowstates_; }
  emulator::Status status() const { return world_->status(0); }
  authority::GateState gate() const { return status().gate; }
  // The angle at which the first motor is commanded to be.
  double commanded() const { return world_->robot(0).command().motors[0].q; }
  double q() const { return world_->physics().robot().q()[0]; }   // of the first joint, rad
  double torque() const { return world_->robot(0).torque()[0]; }  // of the first motor, N·m
  double largest_torque() const { return largest_torque_; }       // of it since the restart
  std::array<double, 2> range() const { return ranges_[0]; }      // of the first joint, rad

 private:
  config::Config config_;
  int domain_, alias_;  // the second is the same domain, reached over the network
  bus::Participant participant_;
  wire::Port port_;
  bus::Stranger stranger_;
  bus::Entity network_;
  bus::Stranger host_;
  emulator::Inbox inbox_;
  std::unique_ptr<emulator::World> world_;
  std::vector<std::array<double, 2>> ranges_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Listener> listener_;
  emulator::Status before_;
  int before_lowstates_ = 0;
  double largest_torque_ = 0;
};

}  // namespace understudy::bad_commands
