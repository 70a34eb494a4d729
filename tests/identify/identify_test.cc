#include "identify/identify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "config/load.h"
#include "tests/identify/randomized_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::identify {
namespace {

using testing::HasSubstr;

class IdentifyTest : public test::MujocoTest {};

TEST_F(IdentifyTest, RefusesTooShortARecording) {
  Drawn drawn{.samples = {.file = "short.csv", .times = {0, 0.01, 0.02}}};
  drawn.samples.q = Eigen::MatrixXd::Zero(12, 3);
  drawn.samples.command_times = {0};
  drawn.samples.commands = {{.motors = std::vector<robot::MotorCommand>(12)}};
  try {
    IdentifiedBy(drawn, {}, false);
    FAIL();
  } catch (const RecordError& error) {
    EXPECT_THAT(error.what(), HasSubstr("record for longer"));
  }
}

TEST_F(IdentifyTest, RefusesAnUnknownParameterWithTheNearest) {
  const config::Config known = Known("go2");
  const Replay replay = ReplayOf(known);
  const Basis basis(known.robots[0].spec, replay.bench(), false);
  try {
    basis.Parameters({"amature"}, replay.bench());
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "--parameters: no 'amature'; did you mean 'armature'?");
  }
}

}  // namespace
}  // namespace understudy::identify
