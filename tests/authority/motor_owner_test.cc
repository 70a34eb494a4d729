#include "authority/motor_owner.h"

#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace understudy::authority {
namespace {

using Starts = std::map<std::string, int, std::less<>>;

// Counts its starts.
class CountingMotion final : public Motion {
 public:
  CountingMotion(std::string_view alias, Starts* starts)
      : starts_(&(*starts)[std::string(alias)]) {}
  void Start(const MotionInput&) override { ++*starts_; }
  MotionVerdict Ask(const MotionGoal&) override { return MotionVerdict::kTaken; }
  void Step(const MotionInput&, double, robot::RobotCommand* command) override {
    command->motors.front().tau = 7;
  }
  robot::MotionState state() const override { return {.id = 1001}; }

 private:
  int* starts_;
};

class MotorOwnerTest : public ::testing::Test {
 protected:
  MotorOwner Make(bool first_on) {
    return {{OnboardService{.name = "sport_mode", .alias = "normal", .on = first_on},
             {.name = "ai_sport", .alias = "ai", .on = false},
             {.name = "vui_service"},
             {.name = "basic_service", .is_protected = true}},
            "0",
            [this](std::string_view alias) {
              return std::make_unique<CountingMotion>(alias, &starts_);
            }};
  }

  Starts starts_;  // by alias
  robot::RobotCommand command_{.motors = std::vector<robot::MotorCommand>(1)};
};

TEST_F(MotorOwnerTest, LetsTheServiceThatIsOnMoveTheMotors) {
  MotorOwner owner = Make(true);
  EXPECT_EQ(owner.active(), "normal");
  EXPECT_TRUE(owner.Step({}, 0.002, &command_));
  EXPECT_EQ(command_.motors[0].tau, 7);
  EXPECT_EQ(owner.state().id, 1001);
  EXPECT_EQ(owner.Ask({}), MotionVerdict::kTaken);
}

TEST_F(MotorOwnerTest, HasNothingToSayOnceReleased) {
  MotorOwner owner = Make(true);
  owner.Release();
  EXPECT_EQ(owner.active(), "");
  EXPECT_FALSE(owner.Step({}, 0.002, &command_));
  EXPECT_EQ(command_.motors[0].tau, 0);
  EXPECT_EQ(owner.state().id, 0);
  EXPECT_EQ(owner.Ask({}), MotionVerdict::kNotNow);
}

TEST_F(MotorOwnerTest, StartsAServiceAnewWheneverItTakesOver) {
  MotorOwner owner = Make(true);
  owner.Step({}, 0.002, &command_);
  owner.Step({}, 0.002, &command_);
  EXPECT_EQ(starts_["normal"], 1);
  EXPECT_EQ(owner.Select("ai"), OwnerVerdict::kDone);
  EXPECT_EQ(owner.active(), "ai");
  owner.Step({}, 0.002, &command_);
  EXPECT_EQ(starts_["normal"], 1);
  EXPECT_EQ(starts_["ai"], 1);
  owner.Select("normal");
  owner.Step({}, 0.002, &command_);
  EXPECT_EQ(starts_["normal"], 2);
}

TEST_F(MotorOwnerTest, HasAControllerOfItsOwnForEachMotionService) {
  Make(true);
  EXPECT_THAT(starts_, ::testing::UnorderedElementsAre(::testing::Pair("normal", 0),
                                                       ::testing::Pair("ai", 0)));
}

TEST_F(MotorOwnerTest, ResetsWhatEndsWithTheMotionService) {
  MotorOwner owner = Make(true);
  const auto change = [&] {
    owner.onboard() = {.silent = true, .user_control = true, .sticks = false};
    EXPECT_TRUE(owner.user_control());
  };
  const auto reset = [&] {
    EXPECT_FALSE(owner.onboard().user_control);
    EXPECT_TRUE(owner.onboard().sticks);
    EXPECT_TRUE(owner.onboard().silent) << "a setting of motion_switcher";
  };
  change();
  owner.Restart();
  reset();
  change();
  owner.Select("ai");
  reset();
  change();
  owner.Switch("ai_sport", false);
  reset();
}

TEST_F(MotorOwnerTest, AvoidsObstaclesWhileTheSwitchIsOnAndTheProgramRuns) {
  MotorOwner owner({{.name = std::string(kAvoidProgram)}}, "0", nullptr);
  EXPECT_FALSE(owner.avoids());
  owner.onboard().avoids = true;
  EXPECT_TRUE(owner.avoids());
  owner.Switch(kAvoidProgram, false);
  EXPECT_FALSE(owner.avoids());
  MotorOwner other({}, "0", nullptr);
  other.onboard().avoids = true;
  EXPECT_TRUE(other.avoids()) << "what is not listed always runs";
}

TEST_F(MotorOwnerTest, KeepsAServiceThatIsSelectedAgain) {
  MotorOwner owner = Make(true);
  owner.Step({}, 0.002, &command_);
  EXPECT_EQ(owner.Select("normal"), OwnerVerdict::kDone);
  owner.Step({}, 0.002, &command_);
  EXPECT_EQ(starts_["normal"], 1);
}

TEST_F(MotorOwnerTest, RefusesNamesItDoesNotKnow) {
  MotorOwner owner = Make(true);
  EXPECT_EQ(owner.Select("mcf"), OwnerVerdict::kUnknownName);
  EXPECT_EQ(owner.Select(""), OwnerVerdict::kUnknownName);
  EXPECT_EQ(owner.Switch("nobody", true), OwnerVerdict::kUnknownName);
  EXPECT_EQ(owner.active(), "normal");
}

TEST_F(MotorOwnerTest, RefusesToSwitchWhatIsProtected) {
  MotorOwner owner = Make(true);
  EXPECT_EQ(owner.Switch("basic_service", false), OwnerVerdict::kProtected);
  EXPECT_TRUE(owner.services()[3].on);
}

TEST_F(MotorOwnerTest, SwitchesOneMotionServiceOffWhenAnotherGoesOn) {
  MotorOwner owner = Make(true);
  EXPECT_EQ(owner.Switch("ai_sport", true), OwnerVerdict::kDone);
  EXPECT_EQ(owner.active(), "ai");
  EXPECT_FALSE(owner.services()[0].on);
  EXPECT_EQ(owner.Switch("ai_sport", false), OwnerVerdict::kDone);
  EXPECT_EQ(owner.active(), "");
  EXPECT_EQ(owner.Switch("vui_service", false), OwnerVerdict::kDone);
  EXPECT_FALSE(owner.services()[2].on);
}

TEST_F(MotorOwnerTest, SaysWhenNothingCanPlayAService) {
  MotorOwner owner({{.name = "ai_sport", .alias = "ai", .on = false}}, "0", nullptr);
  EXPECT_EQ(owner.Select("ai"), OwnerVerdict::kNoController);
  EXPECT_EQ(owner.active(), "");
}

}  // namespace
}  // namespace understudy::authority
