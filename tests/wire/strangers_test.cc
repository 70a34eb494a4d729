#include "wire/strangers.h"

#include <memory>
#include <optional>
#include <set>
#include <string>

#include <dds/dds.h>
#include <gmock/gmock.h>

#include "bus/writer.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Somebody else's participant in a domain that this process has already, with a writer of
// rt/lowstate.
class Stranger {
 public:
  Stranger(int domain, const dds_topic_descriptor* type)
      : participant_(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                     "create a stranger"),
        writer_(dds_create_writer(participant_.handle(), MakeTopic(type), nullptr, nullptr),
                "create the stranger's writer") {}

  bus::ParticipantKey key() const {
    dds_guid_t guid{};
    dds_get_guid(participant_.handle(), &guid);
    return std::to_array(guid.v);
  }
  template <typename Msg>
  void Say(const Msg& message) const {
    dds_write(writer_.handle(), &message);
  }

 private:
  dds_entity_t MakeTopic(const dds_topic_descriptor* type) const {
    return dds_create_topic(participant_.handle(), type, "rt/lowstate", nullptr, nullptr);
  }

  bus::Entity participant_, writer_;
};

const unitree_go_msg_dds__LowState_ kGoState{};
const unitree_hg_msg_dds__LowState_ kHgState{};

// Polls until `count` strangers have appeared.
void AwaitStrangers(StrangerWatch* watch, std::size_t count) {
  std::size_t appeared = 0;
  ASSERT_TRUE(
      test::Eventually([&] { return (appeared += watch->Poll().appeared.size()) == count; }));
}

// Polls while the stranger speaks until somebody is heard for the first time.
template <typename Msg>
std::vector<bus::Neighbour> AwaitSpeech(StrangerWatch* watch, const Stranger& stranger,
                                        const Msg& message) {
  std::vector<bus::Neighbour> spoke;
  test::Eventually([&] {
    stranger.Say(message);
    spoke = watch->Poll().spoke;
    return !spoke.empty();
  });
  return spoke;
}

TEST(StrangerWatchTest, KnowsNobodyOnAnEmptyBusNorItself) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  bus::Writer<unitree_go_msg_dds__LowState_> writer(ours, kGoLowState);
  StrangerWatch watch(ours);
  ASSERT_TRUE(writer.Write(kGoState));
  const StrangerWatch::News news = watch.Poll();
  EXPECT_THAT(news.appeared, IsEmpty());
  EXPECT_THAT(news.spoke, IsEmpty());
  EXPECT_THAT(watch.silent(), IsEmpty());
  EXPECT_THAT(watch.speaking(), IsEmpty());
}

// Types of rt/lowstate by which `participant` reads or writes, once discovery has seen a writer.
std::set<std::string> TypesOfLowState(const bus::Participant& participant, StrangerWatch* watch) {
  bus::EndpointSurvey survey(participant, bus::SurveyOf::kAll);
  std::set<std::string> types;
  test::Eventually([&] {
    watch->Poll();
    survey.Poll();
    for (const bus::Endpoint& endpoint : survey.endpoints()) {
      if (endpoint.topic == "rt/lowstate") types.insert(endpoint.who.type);
    }
    return !types.empty();
  });
  return types;
}

TEST(StrangerWatchTest, LeavesTheTopicOfARobotThatIsAloneOneType) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<unitree_go_msg_dds__LowState_> writer(ours, kGoLowState);
  StrangerWatch watch(ours);
  EXPECT_THAT(TypesOfLowState(ours, &watch), ElementsAre("unitree_go::msg::dds_::LowState_"));
}

TEST(StrangerWatchTest, AStrangerAppearsOnceAndIsSilentUntilItSpeaks) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  StrangerWatch watch(ours);
  const Stranger stranger(domain, kGoLowState.descriptor);
  AwaitStrangers(&watch, 1);
  EXPECT_THAT(watch.Poll().appeared, IsEmpty());
  EXPECT_THAT(watch.silent(), SizeIs(1));
  EXPECT_THAT(watch.speaking(), IsEmpty());
}

TEST(StrangerWatchTest, NamesTheOneThatSpeaksAmongSeveral) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  StrangerWatch watch(ours);
  const Stranger first(domain, kGoLowState.descriptor), second(domain, kHgLowState.descriptor),
      third(domain, kGoLowState.descriptor);
  AwaitStrangers(&watch, 3);

  const std::vector<bus::Neighbour> spoke = AwaitSpeech(&watch, second, kHgState);

  ASSERT_THAT(spoke, SizeIs(1));
  EXPECT_EQ(spoke.front().participant, second.key());
  EXPECT_THAT(watch.silent(), SizeIs(2));
  ASSERT_THAT(watch.speaking(), SizeIs(1));
  EXPECT_EQ(watch.speaking().front().participant, second.key());
}

TEST(StrangerWatchTest, TellsOfASecondSpeakerWhileTheFirstGoesOn) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  StrangerWatch watch(ours);
  const Stranger first(domain, kGoLowState.descriptor), second(domain, kGoLowState.descriptor);
  AwaitStrangers(&watch, 2);
  ASSERT_THAT(AwaitSpeech(&watch, first, kGoState), SizeIs(1));
  for (int i = 0; i < 10; ++i) first.Say(kGoState);

  const std::vector<bus::Neighbour> spoke = AwaitSpeech(&watch, second, kGoState);

  ASSERT_THAT(spoke, SizeIs(1));
  EXPECT_EQ(spoke.front().participant, second.key());
  EXPECT_THAT(watch.speaking(), SizeIs(2));
}

TEST(StrangerWatchTest, ForgetsASpeakerThatHasGone) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  StrangerWatch watch(ours);
  std::optional<Stranger> stranger;
  stranger.emplace(domain, kGoLowState.descriptor);
  AwaitStrangers(&watch, 1);
  ASSERT_THAT(AwaitSpeech(&watch, *stranger, kGoState), SizeIs(1));
  stranger.reset();
  EXPECT_TRUE(test::Eventually([&] {
    watch.Poll();
    return watch.speaking().empty();
  }));
}

// Somebody else's participant that announces a robot, without a writer at first.
class Rival {
 public:
  Rival(int domain, std::int64_t since) {
    const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(),
                                                                    &dds_delete_qos);
    const std::string says = AnnounceRobot(since);
    dds_qset_userdata(qos.get(), says.data(), says.size());
    participant_.emplace(
        dds_create_participant(static_cast<dds_domainid_t>(domain), qos.get(), nullptr), "join");
  }
  void Start() {
    writer_.emplace(
        dds_create_writer(participant_->handle(),
                          dds_create_topic(participant_->handle(), kGoLowState.descriptor,
                                           "rt/lowstate", nullptr, nullptr),
                          nullptr, nullptr),
        "start");
  }

 private:
  std::optional<bus::Entity> participant_, writer_;
};

TEST(StrangerWatchTest, KnowsTheRobotsThatBeganToStartBeforeUs) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain, AnnounceRobot(1000));
  StrangerWatch watch(ours);
  Rival elder(domain, 999), younger(domain, 1001);
  EXPECT_TRUE(test::Eventually([&] {
    watch.Poll();
    return watch.EldersStarting().size() == 1;
  }));
  elder.Start();
  younger.Start();
  std::vector<bus::Neighbour> appeared;
  ASSERT_TRUE(test::Eventually([&] {
    for (bus::Neighbour& one : watch.Poll().appeared) appeared.push_back(std::move(one));
    return appeared.size() == 2;
  }));
  EXPECT_TRUE(watch.EldersStarting().empty());
  std::vector<StrangerWatch::Kind> kinds{watch.KindOf(appeared[0]), watch.KindOf(appeared[1])};
  EXPECT_THAT(kinds, testing::UnorderedElementsAre(StrangerWatch::Kind::kElder,
                                                   StrangerWatch::Kind::kYounger));
}

TEST(StrangerWatchTest, RanksNobodyWhoAnnouncesNothing) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain, AnnounceRobot(1000));
  StrangerWatch watch(ours);
  const Stranger stranger(domain, kGoLowState.descriptor);
  AwaitStrangers(&watch, 1);
  EXPECT_EQ(watch.KindOf(watch.silent().front()), StrangerWatch::Kind::kOther);
  EXPECT_TRUE(watch.EldersStarting().empty());
}

TEST(RobotRankTest, IsComputedAlikeByBoth) {
  const bus::ParticipantKey low{1}, high{2};
  const auto a = RankOf(AnnounceRobot(7), low), b = RankOf(AnnounceRobot(7), high),
             c = RankOf(AnnounceRobot(8), low);
  EXPECT_LT(*a, *b);
  EXPECT_LT(*b, *c);
  for (const char* text : {"", "understudy", "understudy robot since ", "understudy robot since x",
                           "understudy robot since 7 ", "ros2"}) {
    EXPECT_FALSE(RankOf(text, low)) << text;
  }
}

TEST(StrangersTest, AreDescribedOneByOne) {
  const bus::Neighbour one{.process = "a", .pid = "1"}, two{.process = "b", .pid = "2"};
  EXPECT_EQ(Describe(std::vector<bus::Neighbour>{}), "");
  EXPECT_EQ(Describe(std::vector{one}), "process 1 (a)");
  EXPECT_EQ(Describe(std::vector{one, two}), "process 1 (a) and process 2 (b)");
  EXPECT_EQ(Describe(std::vector{one, two, one}), "process 1 (a), process 2 (b) and process 1 (a)");
}

TEST(StrangerWatchTest, SeesOnlyRobotsOfItsPartition) {
  const int domain = test::NewDomain();
  const bus::Participant left("lo", domain, AnnounceRobot(1, "left"), "left"),
      right("lo", domain, AnnounceRobot(2, "right"), "right"),
      again("lo", domain, AnnounceRobot(3, "left"), "left");
  const bus::Writer<unitree_go_msg_dds__LowState_> writer(left, kGoLowState);
  StrangerWatch of_right(right), of_left(again);
  AwaitStrangers(&of_left, 1);
  EXPECT_EQ(of_left.KindOf(bus::Neighbour{.participant = left.key()}), StrangerWatch::Kind::kElder);
  EXPECT_THAT(of_right.Poll().appeared, IsEmpty());
  EXPECT_THAT(of_right.EldersStarting(), IsEmpty());
}

}  // namespace
}  // namespace understudy::wire
