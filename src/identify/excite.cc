#include "identify/excite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "base/errors.h"
#include "base/signals.h"
#include "bus/discovery.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/unitree_api.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "wire/message_crc.h"
#include "wire/robot_rank.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy::identify {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// *Assumed*, all of them.
constexpr auto kPeriod = 2ms;      // of commands, as the vendor's examples have it
constexpr auto kLongestWait = 3s;  // for the first state, and for others to be discovered
constexpr auto kListen = 500ms;    // for writers of topics that are discovered late
constexpr auto kAnswer = 2s;       // of a service
constexpr auto kAskAgain = 300ms;
constexpr auto kSilence = 200ms;      // without a state, after which the program ends
constexpr double kInTheWay = 0.6;     // rad between a joint and its command
constexpr double kWeightShare = 0.3;  // of the weight on the feet: it stands on them
constexpr double kShowEvery = 0.1;    // s
constexpr double kGravity = 9.81;     // m/s²

constexpr bus::Topic<unitree_api_msg_dds__Request_> kAsk{"rt/api/motion_switcher/request",
                                                         &unitree_api_msg_dds__Request__desc};
constexpr bus::Topic<unitree_api_msg_dds__Response_> kAnswered{
    "rt/api/motion_switcher/response", &unitree_api_msg_dds__Response__desc};
constexpr std::int64_t kCheckMode = 1001;  // motion_switcher's api

template <class Cmd, class State>
class Exciter {
 public:
  Exciter(const robot::RobotSpec& spec, const bus::Participant& participant,
          const bus::Topic<Cmd>& command, const bus::Topic<State>& state)
      : spec_(spec),
        participant_(participant),
        writer_(participant, command),
        reader_(participant, state),
        states_(participant, state.name),
        commanders_(participant, command.name),
        announced_(participant) {}

  void RequireRobot(bool real) {
    const auto until = Clock::now() + kLongestWait;
    while (!Hear() && Clock::now() < until && StopSignal() == 0) std::this_thread::sleep_for(10ms);
    if (!state_) {
      throw BusError(fmt::format("no rt/lowstate on {}, domain {}: is the robot on?",
                                 participant_.interface(), participant_.domain()));
    }
    std::this_thread::sleep_for(kListen);
    for (const bus::Neighbour& one : states_.Poll()) {
      if (real || IsOurs(one.participant)) continue;
      throw NeighbourError("rt/lowstate is of a robot that is not understudy's, " +
                           bus::Describe(one) +
                           ": for a real robot on a stand add --on-a-real-robot");
    }
    for (const bus::Neighbour& one : commanders_.Poll()) {
      throw ControlError("somebody else commands the motors on rt/lowcmd, " + bus::Describe(one) +
                         ": end that program; a motion service that does so has to be released "
                         "(MotionSwitcherClient.ReleaseMode)");
    }
  }

  // Asks motion_switcher who has the motors.
  void RequireReleased(const std::function<void(const std::string&)>& told) {
    bus::Writer<unitree_api_msg_dds__Request_> ask(participant_, kAsk);
    bus::Reader<unitree_api_msg_dds__Response_> answers(participant_, kAnswered,
                                                        {.reliable = true});
    const std::int64_t id = Clock::now().time_since_epoch().count();
    const auto until = Clock::now() + kAnswer;
    std::optional<std::string> answer;
    Clock::time_point ask_at{};
    while (!answer && Clock::now() < until && StopSignal() == 0) {
      // Again and again: an answer is lost where the other side does not know of our reader yet.
      if (Clock::now() >= ask_at && ask.matched_readers() > 0 && answers.matched_writers() > 0) {
        ask_at = Clock::now() + kAskAgain;
        std::string none;
        unitree_api_msg_dds__Request_ request{};
        request.header.identity = {.id = id, .api_id = kCheckMode};
        request.parameter = none.data();
        ask.Write(request);
      }
      answers.Take([&](const unitree_api_msg_dds__Response_& one, auto) {
        if (one.header.identity.id == id && one.data != nullptr) answer = one.data;
      });
      std::this_thread::sleep_for(10ms);
    }
    if (!answer) {
      told("motion_switcher does not answer: make sure that no motion service has the motors");
      return;
    }
    const nlohmann::json json = nlohmann::json::parse(*answer, nullptr, false);
    if (!json.is_object() || !json.contains("name") || !json["name"].is_string()) return;
    const std::string name = json["name"];
    if (name.empty()) return;
    throw ControlError(
        "the motion service '" + name.substr(0, 40) +
        "' has the motors: put the robot on its stand and release it "
        "(MotionSwitcherClient.ReleaseMode), or start the simulated one with --released");
  }

  void RequireStand(double mass, const std::function<void(const std::string&)>& told) {
    if constexpr (requires { state_->foot_force; }) {
      const robot::FootSensorSpec& sensor = spec_.foot_sensor;
      if (sensor.counts_per_newton > 0 && !spec_.feet.empty()) {
        double force = 0;
        for (std::size_t i = 0; i < std::min<std::size_t>(spec_.feet.size(), 4); ++i) {
          force += (state_->foot_force[i] - sensor.offset_counts) / sensor.counts_per_newton;
        }
        const double share = force / (mass * kGravity);
        if (share < kWeightShare) return;
        throw ControlError(fmt::format(
            "its feet carry {:.0f} % of its weight: put it on a stand, legs free", 100 * share));
      }
    }
    told("nothing measures what its feet carry: make sure that its limbs are free");
  }

  std::vector<double> q() const {
    std::vector<double> q;
    for (const auto& motor : spec_.motors) q.push_back(state_->motor_state[wire::SlotOf(motor)].q);
    return q;
  }

  ExciteEnd Run(const Excitation& program,
                const std::function<void(double done, double whole)>& progress) {
    const auto begin = Clock::now();
    double shown = -kShowEvery;
    double stopped = -1;
    ExciteEnd end = ExciteEnd::kDone;
    for (auto due = begin;; due += kPeriod) {
      std::this_thread::sleep_until(due);
      const double t = std::chrono::duration<double>(Clock::now() - begin).count();
      Hear();
      if (Clock::now() - heard_ > kSilence) {
        throw BusError("rt/lowstate fell silent; the last command was " +
                       fmt::format("{:.1f} s in", t));
      }
      const robot::RobotCommand command = program.At(t, stopped);
      if (stopped < 0) {
        if (StopSignal() != 0) end = ExciteEnd::kStopped;
        if (IsFarOff(command)) end = ExciteEnd::kInTheWay;
        if (end != ExciteEnd::kDone) stopped = t;
      }
      Send(command);
      if (t >= shown + kShowEvery) progress(shown = t, program.seconds());
      if (t > program.seconds() || (stopped >= 0 && t > stopped + Excitation::kSoften)) return end;
    }
  }

 private:
  bool Hear() {
    reader_.Take([&](const State& state, auto) {
      state_ = state;
      heard_ = Clock::now();
    });
    return state_.has_value();
  }

  bool IsOurs(const bus::ParticipantKey& key) {
    return std::ranges::any_of(announced_.Poll(), [&](const bus::Announcement& one) {
      return one.participant == key && wire::RankOf(one.text, one.participant).has_value();
    });
  }

  bool IsFarOff(const robot::RobotCommand& command) const {
    const std::vector<double> at = q();
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (std::abs(at[i] - command.motors[i].q) > kInTheWay) return true;
    }
    return false;
  }

  void Send(const robot::RobotCommand& command) {
    Cmd message{};
    if constexpr (requires { message.head; }) {
      message.head[0] = 0xFE;
      message.head[1] = 0xEF;
      message.level_flag = 0xFF;
    } else {
      message.mode_machine = state_->mode_machine;
    }
    for (std::size_t i = 0; i < command.motors.size(); ++i) {
      auto& motor = message.motor_cmd[wire::SlotOf(spec_.motors[i])];
      motor.mode = 1;
      motor.q = static_cast<float>(command.motors[i].q);
      motor.kp = static_cast<float>(command.motors[i].kp);
      motor.kd = static_cast<float>(command.motors[i].kd);
    }
    message.crc = wire::MessageCrc(message);
    writer_.Write(message);
  }

  const robot::RobotSpec& spec_;
  const bus::Participant& participant_;
  bus::Writer<Cmd> writer_;
  bus::Reader<State> reader_;
  bus::NeighbourWatch states_, commanders_;
  bus::AnnouncementWatch announced_;
  std::optional<State> state_;
  Clock::time_point heard_{};
};

}  // namespace

ExciteEnd Excite(const robot::RobotSpec& spec, const physics::Bench& bench,
                 const ExciteSettings& settings,
                 const std::function<void(const std::string&)>& told,
                 const std::function<void(double done, double whole)>& progress) {
  const bus::Participant participant(settings.interface, settings.domain);
  const auto run = [&](const auto& command, const auto& state) {
    Exciter exciter(spec, participant, command, state);
    exciter.RequireRobot(settings.on_a_real_robot);
    exciter.RequireReleased(told);
    exciter.RequireStand(bench.mass(), told);
    if (StopSignal() != 0) return ExciteEnd::kStopped;
    const Excitation program(spec, settings.excitation, exciter.q(), bench.ranges());
    told(fmt::format("{:.0f} s; Ctrl-C ends it softly", program.seconds()));
    return exciter.Run(program, progress);
  };
  return spec.family == robot::WireFamily::kHg ? run(wire::kHgLowCmd, wire::kHgLowState)
                                               : run(wire::kGoLowCmd, wire::kGoLowState);
}

}  // namespace understudy::identify
