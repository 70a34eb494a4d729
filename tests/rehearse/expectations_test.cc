#include "rehearse/expectations.h"

#include "tests/rehearse/rehearse_fixture.h"

namespace understudy::rehearse {
namespace {

std::string ErrorIn(const std::string& expectation) {
  return config::ErrorOf([&] { ReadExpect("- " + expectation); });
}

TEST(ExpectationsTest, AreNamedByWhatTheyAskUnlessTheyHaveAName) {
  EXPECT_EQ(ReadExpect("[{always: base.height > 0.2, from: 1}]").list[0].name,
            "always base.height > 0.2, from 1 s");
  EXPECT_EQ(ReadExpect("[{always: base.height > 0.2, name: up}]").list[0].name, "up");
}

TEST(ExpectationsTest, ShareTheSignalsOfAll) {
  const Expectations expect =
      ReadExpect("[{always: base.height > 0.2}, {never: base.height > 1 or base.tilt > 10 deg}]");
  ASSERT_EQ(expect.signals.size(), 2U);
  EXPECT_EQ(expect.list[1].signals, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(expect.list[1].leaves[1].unit, "deg");
}

TEST(ExpectationsTest, ReadSafeAsTheStandardSet) {
  const Expectations expect = ReadExpect("[safe, {always: base.height > 0.2}]");
  EXPECT_TRUE(expect.safe);
  ASSERT_EQ(expect.list.size(), 4U);
  EXPECT_EQ(expect.list[0].name, "stays upright");
  EXPECT_EQ(expect.list[0].where, "e:1");
  EXPECT_EQ(expect.list[2].asks, "never call_refused happens");
  EXPECT_FALSE(ReadExpect("[{always: base.height > 0.2}]").safe);
}

TEST(ExpectationsTest, SayWhereAndWhatIsWrongWithTheNearestWord) {
  const std::pair<const char*, const char*> kRows[] = {
      {"{alway: base.x > 0}", "e:1: key 'alway': unknown; did you mean 'always'?"},
      {"{from: 1}", "e:1: an expectation needs one of always, never, eventually"},
      {"{always: base.x > 0, never: base.x > 0}", "cannot be both always and never"},
      {"{always: base.hight > 0}", "always: no signal 'base.hight'; did you mean 'base.height'?"},
      {"{always: torque(kne) > 0}", "no joint 'kne'; did you mean 'knee'?"},
      {"{always: foot_force(rihgt) > 0}", "no foot 'rihgt'; did you mean 'right'?"},
      {"{always: hand_force(lfet) > 0}", "no hand 'lfet'; did you mean 'left'?"},
      {"{always: gap(lowcmt) > 0}", "no topic 'rt/lowcmt'; did you mean 'rt/lowcmd'?"},
      {"{always: refusd happens}", "no event 'refusd'; did you mean 'refused'?"},
      {"{always: gate.stat is damping}",
       "no field of the event gate 'stat'; did you mean 'state'?"},
      {"{always: base.tilt > 3 degrees}", "base.tilt: no unit 'degrees'"},
      {"{always: base.tilt is level}", "base.tilt is a number, got 'level'"},
      {"{always: 'rt/lowstate:imu_state.rpi[0] > 0'}", "did you mean 'rpy'?"},
      {"{always: base.x}", "expected one of < <= > >= is between happens arrives"},
      {"{always: base.x > 0, within: 2}", "within: with always only beside until"},
      {"{final: base.x > 0, within: 2}", "key 'within': not with final"},
      {"{stays: base.x > 0}", "for: missing; expected seconds"},
      {"{count: base.x > 0}", "count needs least, most or both"},
      {"{count: base.x > 0, least: 3, most: 2}", "most is less than least"},
      {"{always: base.x > 0, from: 3, to: 2}", "to: the window ends before it begins"},
      {"{always: base.x > 0, to: 3, during: 2}", "during: the window already ends with `to`"},
      {"{always: base.x > 0, from: -1}", "from: expected a number from 0 to 1000000 s, got '-1'"},
      {"{always: [base.x]}", "always: expected a condition, as in base.height > 0.3, got a list"},
  };
  for (const auto& [expectation, error] : kRows) {
    EXPECT_THAT(ErrorIn(expectation), testing::HasSubstr(error)) << expectation;
  }
  EXPECT_THAT(config::ErrorOf([] { ReadExpect("[{always: base.x > 0}, {always: base.x > 0}]"); }),
              testing::HasSubstr("is the name of that at e:1"));
}

}  // namespace
}  // namespace understudy::rehearse
