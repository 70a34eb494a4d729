#include "mjcf/mujoco_hooks.h"

#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"

namespace understudy::mjcf {
namespace {

class MujocoHooksTest : public testing::Test {
 protected:
  MujocoHooksTest() { InstallMujocoHooks(); }
};

TEST_F(MujocoHooksTest, KeepTheLastWarningUntilItIsTaken) {
  mju_warning("first, and longer than the other one");
  mju_warning("second");
  EXPECT_EQ(TakeMujocoWarning(), "second");
  EXPECT_EQ(TakeMujocoWarning(), "");
}

TEST_F(MujocoHooksTest, CutAWarningThatIsTooLong) {
  mju_user_warning(std::string(10'000, 'x').c_str());
  EXPECT_EQ(TakeMujocoWarning(), std::string(511, 'x'));
}

// Else a compile in one thread would have the run in another one tell its warnings.
TEST_F(MujocoHooksTest, KeepTheWarningsOfThreadsApart) {
  mju_warning("ours");
  std::thread([] {
    EXPECT_EQ(TakeMujocoWarning(), "");
    mju_warning("theirs");
  }).join();
  EXPECT_EQ(TakeMujocoWarning(), "ours");
}

// They are globals that a tick in another thread may be reading.
TEST_F(MujocoHooksTest, AreWrittenOnce) {
  const auto ours = mju_user_warning;
  mju_user_warning = nullptr;
  InstallMujocoHooks();
  EXPECT_EQ(mju_user_warning, nullptr);
  mju_user_warning = ours;
}

TEST_F(MujocoHooksTest, TurnAnErrorIntoAModelError) {
  EXPECT_THROW(mju_error("no way"), ModelError);
}

}  // namespace
}  // namespace understudy::mjcf
