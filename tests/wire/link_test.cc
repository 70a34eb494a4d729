#include "wire/link.h"

#include <vector>

#include <gmock/gmock.h>

#include "tests/support/allocations.h"
#include "wire/inlet.h"

namespace understudy::wire {
namespace {

using robot::LinkEffects;
using testing::ElementsAre;
using testing::IsEmpty;

// Numbers over a link; a damaged one comes negative.
class LinkTest : public testing::Test {
 protected:
  // What arrives at t, of a number that is sent then and of earlier ones.
  std::vector<int> Sent(int number, const LinkEffects& faults, double t = 0) {
    EXPECT_TRUE(link_.Send(faults, t, [number](int* message, bool damaged) {
      *message = damaged ? -number : number;
    }));
    return Arrived(t);
  }
  std::vector<int> Arrived(double t) {
    std::vector<int> arrived;
    while (const int* const message = link_.Arrived(t)) arrived.push_back(*message);
    return arrived;
  }

  Link<int> link_{true, 0.1};
};

TEST_F(LinkTest, IsClearWhileNothingIsWrongOrUnderWay) {
  EXPECT_TRUE(link_.IsClear({}));
  for (const LinkEffects& faults :
       {LinkEffects{.drops = true}, LinkEffects{.doubles = true}, LinkEffects{.damages = true},
        LinkEffects{.reorders = true}, LinkEffects{.delay = 0.1}}) {
    EXPECT_FALSE(link_.IsClear(faults));
  }
  Sent(1, {.delay = 0.1});
  EXPECT_FALSE(link_.IsClear({}));
  EXPECT_THAT(Arrived(0.1), ElementsAre(1));
  EXPECT_TRUE(link_.IsClear({}));
  Sent(2, {.reorders = true}, 0.1);
  EXPECT_FALSE(link_.IsClear({}));
}

TEST_F(LinkTest, LosesDoublesAndDamages) {
  EXPECT_THAT(Sent(1, {}), ElementsAre(1));
  EXPECT_THAT(Sent(2, {.drops = true}), IsEmpty());
  EXPECT_THAT(Sent(3, {.doubles = true}), ElementsAre(3, 3));
  EXPECT_THAT(Sent(4, {.damages = true}), ElementsAre(-4));
  link_ = Link<int>(/*has_crc=*/false);
  EXPECT_THAT(Sent(5, {.damages = true}), IsEmpty()) << "what nobody could tell from a good one";
}

TEST_F(LinkTest, PutsAMessageBehindTheNextOne) {
  EXPECT_THAT(Sent(1, {.reorders = true}), IsEmpty());
  EXPECT_THAT(Sent(2, {.reorders = true}), ElementsAre(2, 1));
  EXPECT_THAT(Sent(3, {.reorders = true}), IsEmpty());
  EXPECT_THAT(Sent(4, {.doubles = true}), ElementsAre(4, 4, 3));
  EXPECT_THAT(Sent(5, {.reorders = true}, 1), IsEmpty());
  EXPECT_THAT(Sent(6, {}, 1.2), ElementsAre(6)) << "5 has waited too long";
}

TEST_F(LinkTest, DelaysAMessageAndThoseBehindIt) {
  EXPECT_THAT(Sent(1, {.delay = 0.3}, 0), IsEmpty());
  EXPECT_THAT(Sent(2, {.delay = 0.1}, 0.1), IsEmpty());
  EXPECT_THAT(Sent(3, {}, 0.2), IsEmpty());
  EXPECT_TRUE(link_.any_late());
  EXPECT_THAT(Arrived(0.29), IsEmpty());
  EXPECT_THAT(Arrived(0.3), ElementsAre(1, 2, 3));
  EXPECT_FALSE(link_.any_late());
}

TEST_F(LinkTest, GivesALateMessageTheFaultsOfTheMomentItWasSent) {
  Sent(1, {.doubles = true, .delay = 0.1});
  Sent(2, {.damages = true, .delay = 0.1});
  Sent(3, {.reorders = true, .delay = 0.1});
  Sent(4, {.delay = 0.1});
  EXPECT_THAT(Arrived(0.1), ElementsAre(1, 1, -2, 4, 3));
}

TEST_F(LinkTest, ForgetsAllThatIsUnderWayOnceItIsCleared) {
  Sent(1, {.delay = 0.1});
  link_.Clear();
  EXPECT_THAT(Arrived(1), IsEmpty());
  Sent(2, {.reorders = true}, 1);
  link_.Clear();
  EXPECT_THAT(Sent(3, {}, 1), ElementsAre(3));
  link_.Send({.doubles = true}, 1, [](int* message, bool) { *message = 4; });
  link_.Arrived(1);
  link_.Clear();
  EXPECT_THAT(Arrived(1), IsEmpty());
}

TEST_F(LinkTest, HasNoRoomForAnyNumberOfLateMessages) {
  const auto send = [this] { return link_.Send({.delay = 1}, 0, [](int*, bool) {}); };
  for (std::size_t i = 0; i < LateQueue<int>::kMost; ++i) ASSERT_TRUE(send());
  EXPECT_FALSE(send());
}

// The command of an Inlet to which commands with that form come, one in each call.
class InletTest : public testing::Test {
 protected:
  bool Take(const LinkEffects& faults, robot::Refusal form, double torque = 1, double t = 0) {
    const auto sent = [&](robot::RobotCommand* command, robot::Refusal* its_form) {
      if (!robot::IsUnreadable(form)) command->motors[0].tau = torque;
      *its_form = form;
      return !std::exchange(sent_, true);
    };
    sent_ = false;
    return inlet_.Take(faults, t, sent, &command_, &form_);
  }

  Inlet inlet_{/*has_crc=*/true};
  robot::RobotCommand command_{.motors = std::vector<robot::MotorCommand>(2)};
  robot::Refusal form_ = robot::Refusal::kNone;
  bool sent_ = false;
};

TEST_F(InletTest, GivesADamagedCommandAWrongCrc) {
  ASSERT_TRUE(Take({.damages = true}, robot::Refusal::kNone));
  EXPECT_EQ(form_, robot::Refusal::kCrc);
  EXPECT_EQ(command_.motors[0].tau, 1);
}

// A lenient intake follows a command with a wrong crc, but nothing that cannot be read.
TEST_F(InletTest, LeavesTheReasonForWhichACommandCannotBeRead) {
  for (const robot::Refusal wrong : {robot::Refusal::kUndecoded, robot::Refusal::kMotorCount}) {
    command_.motors[0].tau = 7;
    ASSERT_TRUE(Take({.damages = true}, wrong));
    EXPECT_EQ(form_, wrong);
    EXPECT_EQ(command_.motors[0].tau, 7) << "stays as it was";
  }
}

TEST_F(InletTest, CountsWhatArrives) {
  EXPECT_TRUE(Take({}, robot::Refusal::kNone));
  EXPECT_FALSE(Take({.drops = true}, robot::Refusal::kNone));
  EXPECT_EQ(inlet_.heard(), 1U);
  EXPECT_TRUE(Take({.doubles = true}, robot::Refusal::kNone, 2));
  sent_ = true;  // nothing more is sent
  const auto nothing = [](robot::RobotCommand*, robot::Refusal*) { return false; };
  EXPECT_TRUE(inlet_.Take({}, 0, nothing, &command_, &form_));
  EXPECT_EQ(command_.motors[0].tau, 2);
  EXPECT_FALSE(inlet_.Take({}, 0, nothing, &command_, &form_));
  EXPECT_EQ(inlet_.heard(), 3U);
  EXPECT_EQ(inlet_.TakeLost(), 0U) << "a faulty link does not say what it loses";
}

TEST_F(InletTest, CountsWhatFoundNoRoomAmongTheLate) {
  for (std::size_t i = 0; i < LateQueue<int>::kMost + 3; ++i) {
    EXPECT_FALSE(Take({.delay = 1}, robot::Refusal::kNone));
  }
  EXPECT_EQ(inlet_.TakeLost(), 3U);
  EXPECT_EQ(inlet_.TakeLost(), 0U);
  inlet_.Clear();
  EXPECT_FALSE(Take({.drops = true}, robot::Refusal::kNone, 1, 2));
}

TEST_F(InletTest, StopsToAllocateOnceItsLinkIsAsFullAsItGets) {
  auto tick = [&, t = 0.0]() mutable {
    t += 0.001;
    Take({.doubles = true, .delay = 0.01}, robot::Refusal::kNone, 1, t);
  };
  for (int i = 0; i < 100; ++i) tick();
  const std::uint64_t before = test::Allocations();
  for (int i = 0; i < 500; ++i) tick();
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace understudy::wire
