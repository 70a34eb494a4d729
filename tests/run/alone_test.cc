#include "run/alone.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <dds/dds.h>
#include <gmock/gmock.h>

#include "base/errors.h"
#include "bus/entity.h"
#include "tests/support/new_domain.h"
#include "wire/topics.h"

namespace understudy::run {
namespace {

using testing::HasSubstr;

// A robot of this program that begins to start, and starts or ends when it is told to.
class Rival {
 public:
  Rival(int domain, std::int64_t since) {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                    &dds_delete_qos);
    const std::string says = wire::AnnounceRobot(since);
    dds_qset_userdata(qos.get(), says.data(), says.size());
    participant_.emplace(
        dds_create_participant(static_cast<dds_domainid_t>(domain), qos.get(), nullptr), "join");
  }
  void Start() {
    writer_.emplace(
        dds_create_writer(participant_->handle(),
                          dds_create_topic(participant_->handle(), wire::kGoLowState.descriptor,
                                           wire::kGoLowState.name, nullptr, nullptr),
                          nullptr, nullptr),
        "start");
  }
  void End() {
    writer_.reset();
    participant_.reset();
  }

 private:
  std::optional<bus::Entity> participant_, writer_;
};

class AloneTest : public testing::Test {
 protected:
  static constexpr std::int64_t kSince = 1000;

  // "" if the robot may start, else why not.
  std::string Refusal(const config::GuardConfig& guard = {}) {
    try {
      RefuseToStartBeside(&watch_, clock_.Now(), participant_, guard, false, &clock_);
      return "";
    } catch (const NeighbourError& error) {
      return error.what();
    }
  }

  const int domain_ = test::NewDomain();
  const bus::Participant participant_{"lo", domain_, wire::AnnounceRobot(kSince)};
  wire::StrangerWatch watch_{participant_};
  time::SteadyClock clock_;
};

TEST_F(AloneTest, StartsWhereNobodyIs) { EXPECT_EQ(Refusal(), ""); }

TEST_F(AloneTest, StartsBeforeOneThatBeganLater) {
  const Rival younger(domain_, kSince + 1);
  EXPECT_EQ(Refusal(), "");
}

TEST_F(AloneTest, YieldsToOneThatBeganEarlierOnceThatWrites) {
  Rival elder(domain_, kSince - 1);
  const std::jthread starts([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // longer than it would listen
    elder.Start();
  });
  EXPECT_THAT(Refusal(), HasSubstr("was there first, so this one yields"));
}

TEST_F(AloneTest, StartsAfterAllIfTheOneThatBeganEarlierDoesNot) {
  Rival elder(domain_, kSince - 1);
  const std::jthread ends([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    elder.End();
  });
  EXPECT_EQ(Refusal(), "");
}

TEST_F(AloneTest, YieldsToOneThatBeganLaterAndWritesAlready) {
  Rival younger(domain_, kSince + 1);
  younger.Start();
  EXPECT_THAT(Refusal(), HasSubstr("was there first"));
}

TEST_F(AloneTest, StartsBesideBothIfItIsOnlyToWarn) {
  const Rival elder(domain_, kSince - 1);
  EXPECT_EQ(Refusal({.on_stranger = config::StrangerAction::kWarn}), "");
}

}  // namespace
}  // namespace understudy::run
