#include <atomic>

#include <gtest/gtest.h>

#include "bus/participant.h"
#include "bus/writer.h"
#include "services/service_host.h"
#include "tests/services/services_fixture.h"
#include "tests/support/new_domain.h"

namespace understudy::services {
namespace {

class SwitchTopicsTest : public testing::Test {
 protected:
  // A writer and a reader of one participant match at once.
  void Say(std::string word) {
    lidar_.Write({.data = word.data()});
    switches_.Poll(&owner_, &calls_);
  }

  std::vector<Call> calls_;
  authority::MotorOwner owner_{{{.name = "unitree_lidar"}}, "0", nullptr};
  Service service_{TableOf("go2", "uwbswitch")};
  bus::Participant participant_{"lo", test::NewDomain()};
  std::atomic<bool> mail_{false};
  SwitchTopics switches_{participant_, &service_, &mail_};
  bus::Writer<std_msgs_msg_dds__String_> lidar_{
      participant_, {"rt/utlidar/switch", &std_msgs_msg_dds__String__desc}};
  bus::Writer<unitree_go_msg_dds__UwbSwitch_> uwb_{
      participant_, {"rt/uwbswitch", &unitree_go_msg_dds__UwbSwitch__desc}};
};

TEST_F(SwitchTopicsTest, SwitchTheLidarsProgramByWord) {
  Say("OFF");
  EXPECT_TRUE(mail_);
  EXPECT_FALSE(owner_.services()[0].on);
  EXPECT_TRUE(calls_.empty());
  Say("off");
  Say("on");
  EXPECT_FALSE(owner_.services()[0].on);
  ASSERT_EQ(calls_.size(), 2U);
  EXPECT_EQ(calls_[0].service, "rt/utlidar/switch");
  EXPECT_EQ(calls_[0].refusal, CallRefusal::kName);
  Say("ON");
  EXPECT_TRUE(owner_.services()[0].on);
}

TEST_F(SwitchTopicsTest, SetWhatTheUwbServiceGives) {
  uwb_.Write({.enabled = 7});
  EXPECT_TRUE(mail_);
  switches_.Poll(&owner_, &calls_);
  EXPECT_EQ(service_.settings().at("enable"), 1);
}

}  // namespace
}  // namespace understudy::services
