// A fixture for whatever makes MuJoCo work.
#ifndef UNDERSTUDY_TESTS_SUPPORT_MUJOCO_TEST_H_
#define UNDERSTUDY_TESTS_SUPPORT_MUJOCO_TEST_H_

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "physics/world_model.h"

namespace understudy::test {

// Any warning of MuJoCo that the test does not take with TakeMujocoWarning() fails it.
class MujocoTest : public testing::Test {
 protected:
  MujocoTest() {
    physics::InstallMujocoHooks();
    physics::TakeMujocoWarning();
  }
  ~MujocoTest() override {
    const std::optional<std::string> warning = physics::TakeMujocoWarning();
    EXPECT_FALSE(warning.has_value()) << "MuJoCo warns: " << *warning;
  }
};

}  // namespace understudy::test

#endif  // UNDERSTUDY_TESTS_SUPPORT_MUJOCO_TEST_H_
