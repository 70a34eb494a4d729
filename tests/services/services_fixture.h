// A robot for services to act on, and good and bad parameters for every row.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "authority/motor_owner.h"
#include "services/service.h"

namespace understudy::services {

// What a test sets and looks at of a FakeMotion.
struct MotionBook {
  authority::MotionVerdict verdict = authority::MotionVerdict::kTaken;
  robot::MotionState state{};
  std::vector<authority::MotionGoal> goals{};
};

// A motion service that writes down what it is asked for.
class FakeMotion final : public authority::Motion {
 public:
  explicit FakeMotion(MotionBook* book) : book_(book) {}
  void Start(const authority::MotionInput&) override {}
  authority::MotionVerdict Ask(const authority::MotionGoal& goal) override {
    book_->goals.push_back(goal);
    return book_->verdict;
  }
  void Step(const authority::MotionInput&, double, robot::RobotCommand*) override {}
  robot::MotionState state() const override { return book_->state; }

 private:
  MotionBook* book_;
};

// Has a FakeMotion play each motion service.
inline authority::MotionMaker Plays(MotionBook* book) {
  return [book](std::string_view) { return std::make_unique<FakeMotion>(book); };
}

// A robot with one motion service, "ai", that is on, and programs with and without protection.
struct ServedRobot {
  MotionBook book;
  authority::MotorOwner owner{{{.name = "ai_sport", .alias = "ai"},
                               {.name = "vui_service"},
                               {.name = "basic_service", .is_protected = true}},
                              "0",
                              Plays(&book)};

  // The motion service is in that state, as of a step of its own.
  void Be(const robot::MotionState& state) {
    book.state = state;
    robot::RobotCommand command;
    owner.Step({}, 0.002, &command);
  }
};

// One call, without the network.
class Caller {
 public:
  explicit Caller(ServiceTable table) : service(std::move(table)) {}

  ServiceReply Ask(std::int64_t api, std::string_view parameter = "", std::int64_t lease = 0) {
    notice.clear();
    return service.Answer({.api_id = api,
                           .lease_id = lease,
                           .parameter = parameter,
                           .parameter_bytes = parameter.size(),
                           .binary_bytes = 0},
                          &robot.owner, now, &notice);
  }

  ServedRobot robot;
  Service service;
  Lease::Time now{0};
  std::string notice;
};

// The table of that robot's service; the test ends when there is none.
ServiceTable TableOf(std::string_view robot, std::string_view service);

}  // namespace understudy::services
