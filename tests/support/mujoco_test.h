// A fixture for tests that use MuJoCo.
#pragma once

#include <gtest/gtest.h>

#include "mjcf/mujoco_hooks.h"

namespace understudy::test {

// Any warning of MuJoCo that the test does not take with mjcf::TakeMujocoWarning() fails it.
class MujocoTest : public testing::Test {
 protected:
  MujocoTest() {
    mjcf::InstallMujocoHooks();
    mjcf::TakeMujocoWarning();
  }
  ~MujocoTest() override { EXPECT_EQ(mjcf::TakeMujocoWarning(), "") << "is what MuJoCo warns of"; }
};

}  // namespace understudy::test
