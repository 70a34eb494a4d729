#include "services/motion_switcher.h"

#include <gtest/gtest.h>

#include "services/service_host.h"

namespace understudy {
namespace {

class MotionSwitcherTest : public testing::Test {
 protected:
  ServiceReply Ask(std::int64_t api, std::string_view parameter = "") {
    return AnswerRequest(&switcher_, api, parameter, &mode_);
  }

  MotionSwitcher switcher_;
  RobotMode mode_;
};

TEST_F(MotionSwitcherTest, SaysByAnEmptyNameThatNoMotionServiceRuns) {
  const ServiceReply reply = Ask(1001);
  EXPECT_EQ(reply.code, 0);
  EXPECT_EQ(reply.data, R"({"form":"0","name":""})");
}

TEST_F(MotionSwitcherTest, TakesNoParameterAsCppAndPythonClientsSendIt) {
  EXPECT_EQ(Ask(1001, "").code, 0);
  EXPECT_EQ(Ask(1001, "{}").code, 0);
}

TEST_F(MotionSwitcherTest, NamesTheMotionServiceThatRuns) {
  mode_.motion_service = "ai";
  EXPECT_EQ(Ask(1001).data, R"({"form":"0","name":"ai"})");
}

TEST_F(MotionSwitcherTest, ReleaseEmptiesTheName) {
  mode_.motion_service = "ai";
  EXPECT_EQ(Ask(1003).code, 0);
  EXPECT_EQ(mode_.motion_service, "");
}

TEST_F(MotionSwitcherTest, ReleaseOfNothingSucceeds) { EXPECT_EQ(Ask(1003).code, 0); }

TEST_F(MotionSwitcherTest, NeverClaimsToHaveStartedAServiceThatIsNotThere) {
  EXPECT_EQ(Ask(1002, R"({"name":"ai"})").code, 7007);
  EXPECT_EQ(mode_.motion_service, "");
}

TEST_F(MotionSwitcherTest, RefusesAnUnknownName) {
  EXPECT_EQ(Ask(1002, R"({"name":"dance"})").code, 7004);
}

TEST_F(MotionSwitcherTest, RefusesANameThatIsNoText) {
  EXPECT_EQ(Ask(1002, R"({"name":7})").code, 7001);
}

TEST_F(MotionSwitcherTest, RefusesAMissingName) { EXPECT_EQ(Ask(1002, "{}").code, 7001); }

TEST_F(MotionSwitcherTest, RefusesWhatIsNoJson) {
  for (const std::string_view bytes : {"", "{", "[[[[", "\xff\xfe", "nan", R"("ai")", "[1,2]"}) {
    EXPECT_EQ(Ask(1002, bytes).code, 7001) << bytes;
    EXPECT_EQ(Ask(1004, bytes).code, 7001) << bytes;
  }
}

TEST_F(MotionSwitcherTest, KeepsSilentModeToBeReadBack) {
  EXPECT_EQ(Ask(1005).data, R"({"silent":false})");
  EXPECT_EQ(Ask(1004, R"({"silent":true})").code, 0);
  EXPECT_EQ(Ask(1005).data, R"({"silent":true})");
}

TEST_F(MotionSwitcherTest, RefusesASilentModeThatIsNoBoolean) {
  EXPECT_EQ(Ask(1004, R"({"silent":1})").code, 7001);
}

TEST_F(MotionSwitcherTest, TellsItsApiVersion) { EXPECT_EQ(Ask(1).data, "1.0.0.1"); }

TEST_F(MotionSwitcherTest, AnswersAnUnknownApiWith3203) {
  for (const std::int64_t api : {0L, 2L, 1000L, 1006L, -1L, 9223372036854775807L}) {
    EXPECT_EQ(Ask(api).code, 3203) << api;
  }
}

TEST_F(MotionSwitcherTest, SendsNoDataWithAFailure) {
  EXPECT_EQ(Ask(1002, R"({"name":"ai"})").data, "");
}

}  // namespace
}  // namespace understudy
