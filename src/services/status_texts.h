// Texts that programs on the robot's computer publish by themselves.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "authority/motor_owner.h"
#include "idl/std_msgs.h"
#include "services/service.h"
#include "wire/outlets.h"

namespace understudy::services {

// Publishes JSON texts (std_msgs String_) on the topics of robot.status_texts, each at its rate of
// simulated time (wire::kStatusTexts), and the list of the robot's programs on rt/servicestate for
// as long as somebody has asked for it (robot_state SetReportFreq).
class StatusTexts {
 public:
  // `topics` are those of wire::ServiceTopics that have a text, and rt/servicestate, which is the
  // last; `services` are all of the robot and must outlive this. Throws BusError.
  StatusTexts(wire::Outlets* outlets, std::span<const wire::RobotTopic> topics,
              std::span<const std::unique_ptr<Service>> services);

  // Publishes what is due at t [s], which must not go back, where somebody reads it. Allocates only
  // for a text that is published.
  void Tell(const authority::MotorOwner& owner, double t);

 private:
  using Text = std::string (*)(std::span<const std::unique_ptr<Service>> services);
  using Outlet = wire::Outlet<std_msgs_msg_dds__String_>;
  struct Told {
    Outlet* outlet;
    Text text;
    double next = 0;  // s
  };
  struct Row;

  static std::span<const Row> Rows();
  static void Send(std::string text, Outlet* outlet);

  std::span<const std::unique_ptr<Service>> services_;
  std::vector<Told> texts_;
  Outlet* report_ = nullptr;
  std::uint64_t asked_ = 0;                    // requests for reports that were seen
  double next_report_ = 0, last_report_ = -1;  // s
};

// Returns a JSON array of the robot's programs: name, status (0 on, 1 off), protect and, where it
// is known, version.
std::string ProgramList(std::span<const authority::OnboardService> services);

}  // namespace understudy::services
