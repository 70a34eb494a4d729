// The world of a run within this process, with nobody at its port.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/config.h"
#include "emulator/world.h"

namespace understudy::bench {

class Alone {
 public:
  explicit Alone(const config::Config& config);

  // A request, carried out in the next step.
  void Ask(std::string_view name, const nlohmann::json& values);
  // Throws std::runtime_error when the physics diverges.
  void Step();

  const emulator::World& world() const { return world_; }

 private:
  // A state is due as often as a LowState is.
  class Port final : public wire::RobotPort {
   public:
    explicit Port(robot::Rate rate) : rate_(rate) {}
    bool Take(std::size_t, robot::RobotCommand*, robot::Refusal*) override { return false; }
    std::uint64_t TakeLost(std::size_t) override { return 0; }
    void Rest() override {}
    bool Due(std::int64_t step) const override { return rate_.Due(step); }
    void Publish(const robot::RobotState&, std::int64_t,
                 std::span<const robot::LinkEffects>) override {}
    std::vector<std::string> topics() const override { return {}; }
    int command_writers() const override { return 0; }
    robot::PortCounts counts() const override { return {}; }
    robot::PortNews TakeNews() override { return {}; }

   private:
    robot::Rate rate_;
  };

  Port port_;
  emulator::Inbox inbox_;
  emulator::World world_;
};

}  // namespace understudy::bench
