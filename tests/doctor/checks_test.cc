#include "doctor/checks.h"

#include <cerrno>
#include <set>

#include <gmock/gmock.h>

#include "doctor/echo_topics.h"
#include "healthy.h"

namespace understudy::doctor {
namespace {

using ::testing::HasSubstr;
using enum CheckVerdict;

constexpr char kGoLowCmdType[] = "unitree_go::msg::dds_::LowCmd_";
constexpr char kHgLowCmdType[] = "unitree_hg::msg::dds_::LowCmd_";
constexpr char kHgLowStateType[] = "unitree_hg::msg::dds_::LowState_";
constexpr char kGoLowStateType[] = "unitree_go::msg::dds_::LowState_";

bus::Endpoint Writer(const char* topic, const char* type) {
  return {.topic = topic, .writes = true, .reliable = true, .who = {.type = type, .pid = "17"}};
}

bus::Endpoint Reader(const char* topic, const char* type) {
  return {.topic = topic, .who = {.type = type, .pid = "18"}};
}

Measurements Among(std::vector<bus::Endpoint> endpoints) {
  return But([&](Measurements& seen) { seen.endpoints = std::move(endpoints); });
}

TEST(ChecksTest, FindNothingWrongWithAHealthyMachine) {
  for (const Check& check : Checks()) {
    const Finding finding = check.judge(Healthy());
    const bool no_states = check.name == "states";  // nobody speaks
    EXPECT_EQ(finding.verdict, no_states ? kNotSeen : kOk) << check.name << ": " << finding.text;
    EXPECT_NE(finding.text, "") << check.name;
  }
}

TEST(ChecksTest, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Check& check : Checks()) EXPECT_TRUE(names.insert(check.name).second) << check.name;
}

TEST(ChecksTest, JudgeAMachineOfWhichNothingWasSeen) {
  Measurements nothing;
  nothing.no_bus = "no network interface 'lo'";
  for (const Check& check : Checks()) {
    const Finding finding = check.judge(nothing);
    EXPECT_TRUE(finding.verdict != kWrong || !finding.remedy.empty()) << check.name;
  }
}

TEST(InterfaceCheckTest, TellsOneThatIsNotThereFromOneThatIsDownAndOneWithoutACarrier) {
  const auto missing = FindingOf("interface", But([](Measurements& seen) {
                                   seen.question.interface = "eht0";
                                   seen.link.reset();
                                 }));
  EXPECT_EQ(missing.verdict, kWrong);
  EXPECT_THAT(missing.remedy, HasSubstr("did you mean 'eth0'?"));
  const auto down = FindingOf("interface", But([](Measurements& seen) { seen.link->up = false; }));
  EXPECT_EQ(down.verdict, kWrong);
  EXPECT_THAT(down.remedy, HasSubstr("ip link set eth0 up"));
  const auto cut =
      FindingOf("interface", But([](Measurements& seen) { seen.link->running = false; }));
  EXPECT_EQ(cut.verdict, kWrong);
  EXPECT_THAT(cut.text, HasSubstr("carrier"));
}

TEST(AddressCheckTest, WantsOneInTheRobotsNetwork) {
  const auto with = [](std::vector<Address> addresses) {
    return FindingOf("address", But([&](Measurements& seen) { seen.addresses = addresses; }));
  };
  EXPECT_EQ(with({}).verdict, kWrong);
  EXPECT_EQ(with({{"eth0", kOurs, kSlash24}}).verdict, kOk);
  EXPECT_EQ(with({{"eth0", 0xC0A87AFF, kSlash24}}).verdict, kWarning);  // 192.168.122.255
  const Finding other = with({{"eth0", 0x0A090801, kSlash24}});
  EXPECT_EQ(other.verdict, kWarning);
  EXPECT_THAT(other.text, HasSubstr("10.9.8.1/24"));
  EXPECT_THAT(with({{"eth0", 0xC0A87BA1, kSlash24}}).text, HasSubstr("the robot's own"));
}

TEST(AddressCheckTest, RefusesTwoInterfacesInOneNetwork) {
  const auto beside = [](std::uint32_t address, std::uint32_t mask) {
    return FindingOf("address", But([&](Measurements& seen) {
                       seen.addresses.push_back({"wlan0", address, mask});
                     }));
  };
  const Finding both = beside(kTheirs, kSlash24);
  EXPECT_EQ(both.verdict, kWrong);
  EXPECT_THAT(both.text, HasSubstr("wlan0 (192.168.123.99/24)"));
  EXPECT_EQ(beside(0xC0A80005, 0xFFFF0000).verdict, kWrong);  // 192.168.0.5/16 has both
  EXPECT_EQ(beside(0xC0A87C05, kSlash24).verdict, kOk);       // 192.168.124.5/24
}

TEST(MulticastCheckTest, ForgivesTheFlagsAbsenceOnLoopbackOnly) {
  const auto without = [](bool loopback) {
    return VerdictOf("multicast", But([&](Measurements& seen) {
                       seen.link->multicast = false;
                       seen.link->loopback = loopback;
                     }));
  };
  EXPECT_EQ(without(true), kWarning);
  EXPECT_EQ(without(false), kWrong);
}

TEST(MulticastCheckTest, WarnsOfARouteThatLeadsElsewhereOrNowhere) {
  for (const char* const to : {"wlan0", ""}) {
    EXPECT_EQ(
        VerdictOf("multicast route", But([&](Measurements& seen) { seen.multicast_route = to; })),
        kWarning)
        << to;
  }
}

TEST(MulticastCheckTest, IsWrongIfADatagramDoesNotComeBack) {
  EXPECT_EQ(
      VerdictOf("multicast here", But([](Measurements& seen) { --seen.self_multicast->returned; })),
      kWrong);
}

TEST(DomainCheckTest, TellsWhyItCannotBeJoined) {
  const auto finding =
      FindingOf("domain", But([](Measurements& seen) { seen.no_bus = "no room for a tenth"; }));
  EXPECT_EQ(finding.verdict, kWrong);
  EXPECT_EQ(finding.text, "no room for a tenth");
}

Finding WithRobots(int speaking, int silent, std::optional<int> wanted) {
  return FindingOf("robots", But([&](Measurements& seen) {
                     seen.question.robots = wanted;
                     seen.robots.insert(seen.robots.end(), static_cast<std::size_t>(speaking),
                                        {.who = "process 5 (robot)", .speaks = true});
                     seen.robots.insert(seen.robots.end(), static_cast<std::size_t>(silent),
                                        {.who = "process 6 (client)", .speaks = false});
                   }));
}

TEST(RobotsCheckTest, WantsAsManyAsAreExpectedAndNeverTwoByChance) {
  EXPECT_EQ(WithRobots(0, 0, std::nullopt).verdict, kOk);
  EXPECT_EQ(WithRobots(1, 0, std::nullopt).verdict, kWarning);
  EXPECT_EQ(WithRobots(2, 0, std::nullopt).verdict, kWrong);
  EXPECT_EQ(WithRobots(0, 0, 0).verdict, kOk);
  EXPECT_EQ(WithRobots(1, 0, 0).verdict, kWrong);
  EXPECT_EQ(WithRobots(1, 0, 1).verdict, kOk);
  EXPECT_EQ(WithRobots(0, 0, 1).verdict, kWrong);
  EXPECT_EQ(WithRobots(2, 0, 2).verdict, kOk);
}

TEST(RobotsCheckTest, NamesThoseThatSpeakAndWarnsOfOneThatOnlyCould) {
  EXPECT_THAT(WithRobots(2, 0, std::nullopt).text, HasSubstr("process 5 (robot)"));
  const Finding silent = WithRobots(0, 1, 0);
  EXPECT_EQ(silent.verdict, kWarning);
  EXPECT_THAT(silent.text, HasSubstr("process 6 (client)"));
}

TEST(StatesCheckTest, WarnsOfPausesOfMoreThanTenPeriods) {
  const auto after = [](double pause) {
    return VerdictOf("states", But([&](Measurements& seen) {
                       seen.states = {.count = 100, .rate = 500, .longest_pause = pause};
                     }));
  };
  EXPECT_EQ(after(0.02), kOk);
  EXPECT_EQ(after(0.021), kWarning);
}

TEST(TypesCheckTest, TakeTheVendorsOwnAndWhatIsNotTheVendors) {
  const Finding finding = FindingOf(
      "types", Among({Writer("rt/lowstate", kGoLowStateType), Reader("rt/lowcmd", kGoLowCmdType),
                      Writer("rt/api/sport/request", "unitree_api::msg::dds_::Request_"),
                      Writer("rt/chatter", "std_msgs::msg::dds_::String_"),
                      Writer(GoEcho::kPing.name, kGoLowCmdType)}));
  EXPECT_EQ(finding.verdict, kOk) << finding.text;
  EXPECT_THAT(finding.text, HasSubstr("3 readers and writers"));
}

TEST(TypesCheckTest, NameWhoHasAnotherTypeAndWhichIsExpected) {
  const Finding finding =
      FindingOf("types", Among({Writer("rt/lf/lowstate", "HelloWorldData::Msg")}));
  EXPECT_EQ(finding.verdict, kWrong);
  EXPECT_THAT(finding.text, HasSubstr("process 17 writes HelloWorldData::Msg instead of "
                                      "unitree_go::msg::dds_::LowState_ or unitree_hg"));
}

TEST(TypesCheckTest, RefuseCommandsOfTheOtherFamilyThanTheRobotsHere) {
  const auto commanded = [](const char* type) {
    return VerdictOf("types",
                     Among({Writer("rt/lowstate", kGoLowStateType), Writer("rt/lowcmd", type)}));
  };
  EXPECT_EQ(commanded(kGoLowCmdType), kOk);
  EXPECT_EQ(commanded(kHgLowCmdType), kWrong);
}

TEST(TypesCheckTest, RefuseAReaderOfTheOtherFamilyUnlessItReadsBoth) {
  bus::Endpoint go = Reader("rt/lowstate", kGoLowStateType);
  bus::Endpoint hg = Reader("rt/lowstate", kHgLowStateType);
  const bus::Endpoint robot = Writer("rt/lowstate", kGoLowStateType);
  EXPECT_EQ(VerdictOf("types", Among({hg})), kOk);
  EXPECT_EQ(VerdictOf("types", Among({robot, hg})), kWrong);
  EXPECT_EQ(VerdictOf("types", Among({robot, hg, go})), kOk);
  go.who.participant[0] = 1;
  EXPECT_EQ(VerdictOf("types", Among({robot, hg, go})), kWrong);
}

TEST(TypesCheckTest, SayWhichTopicAMisspeltOneMayMean) {
  const Finding finding = FindingOf("types", Among({Writer("lowcmd", kGoLowCmdType)}));
  EXPECT_EQ(finding.verdict, kWrong);
  EXPECT_THAT(finding.text, HasSubstr("is rt/lowcmd meant?"));
}

TEST(QualityCheckTest, RefusesWhatTheVendorsDoesNotMatch) {
  const auto reader = [](auto&& change) {
    bus::Endpoint one = Reader("rt/lowstate", kGoLowStateType);
    change(one);
    return VerdictOf("quality", Among({one}));
  };
  EXPECT_EQ(reader([](bus::Endpoint&) {}), kOk);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.reliable = true; }), kOk);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.keeps_for_late = true; }), kWrong);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.exclusive = true; }), kWrong);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.has_deadline = true; }), kWrong);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.xcdr1 = false; }), kWrong);
  EXPECT_EQ(reader([](bus::Endpoint& one) { one.partitions = "\"left\""; }), kWrong);
}

TEST(QualityCheckTest, LetsAWriterOfferMoreThanIsAskedForAndWarnsOfBestEffort) {
  const auto writer = [](auto&& change) {
    bus::Endpoint one = Writer("rt/lowcmd", kGoLowCmdType);
    change(one);
    return VerdictOf("quality", Among({one}));
  };
  EXPECT_EQ(writer([](bus::Endpoint& one) { one.keeps_for_late = one.has_deadline = true; }), kOk);
  EXPECT_EQ(writer([](bus::Endpoint& one) { one.reliable = false; }), kWarning);
  EXPECT_EQ(writer([](bus::Endpoint& one) { one.partitions = "\"left\""; }), kWrong);
}

TEST(ServedCheckTest, NamesWhoWaitsForWhatAndWhoWouldServeIt) {
  EXPECT_EQ(FindingOf("served", Healthy()).verdict, CheckVerdict::kOk);
  const Finding found =
      FindingOf("served", But([](Measurements& seen) {
                  seen.endpoints.push_back(
                      {.topic = "rt/dex1/left/state", .who = {.process = "xr", .pid = "7"}});
                }));
  EXPECT_EQ(found.verdict, CheckVerdict::kWarning);
  EXPECT_THAT(
      found.text,
      testing::AllOf(
          HasSubstr("rt/dex1/left/state: process 7 (xr) reads (served by a robot with Dex1-1"),
          HasSubstr("nobody here serves that")));
}

TEST(PeerCheckTest, IsNotSeenWithoutAPeerAndWrongIfNobodyIsFound) {
  for (const char* const name :
       {"peer", "peer unicast", "peer multicast", "from peer", "round trip"}) {
    EXPECT_EQ(VerdictOf(name, But([](Measurements& seen) { seen.peer.reset(); })), kNotSeen)
        << name;
  }
  EXPECT_EQ(VerdictOf("peer", But([](Measurements& seen) { seen.peer->found = false; })), kWrong);
}

Finding Unicast(int returned, int error) {
  return FindingOf("peer unicast", But([&](Measurements& seen) {
                     seen.peer->unicast = {.sent = 20, .returned = returned, .error = error};
                   }));
}

TEST(PeerCheckTest, TellsByTheKernelsErrorWhyNothingComesBack) {
  EXPECT_THAT(Unicast(0, EPERM).text, HasSubstr("firewall on this machine"));
  EXPECT_THAT(Unicast(0, ECONNREFUSED).text, HasSubstr("no echo runs"));
  EXPECT_THAT(Unicast(0, EHOSTUNREACH).text, HasSubstr("no machine answers"));
  EXPECT_THAT(Unicast(0, ENETUNREACH).text, HasSubstr("no route"));
  EXPECT_THAT(Unicast(0, 0).remedy, HasSubstr("firewall"));
  for (const int error : {EPERM, ECONNREFUSED, EHOSTUNREACH, ENETUNREACH, 0}) {
    EXPECT_EQ(Unicast(0, error).verdict, kWrong) << error;
  }
  EXPECT_EQ(Unicast(19, 0).verdict, kWarning);
}

TEST(FirewallCheckTest, IsToldByWhatPasses) {
  const auto with = [](auto&& change) { return VerdictOf("firewall", But(change)); };
  EXPECT_EQ(with([](Measurements& seen) { seen.peer.reset(); }), kNotSeen);
  EXPECT_EQ(with([](Measurements& seen) { seen.self_multicast->error = EPERM; }), kWrong);
  EXPECT_EQ(with([](Measurements& seen) { seen.peer->unicast.error = EPERM; }), kWrong);
  EXPECT_EQ(with([](Measurements& seen) { seen.peer->multicast.returned = 0; }), kNotSeen);
  EXPECT_EQ(with([](Measurements& seen) { seen.peer->unicast.returned = 0; }), kWrong);
}

CheckVerdict RoundTripOf(int lost, double p99, double worst) {
  return VerdictOf("round trip", But([&](Measurements& seen) {
                     seen.peer->returned = seen.peer->sent - lost;
                     seen.peer->there_and_back = {.count = 1, .p99 = p99, .worst = worst};
                   }));
}

TEST(RoundTripCheckTest, WarnsOfALossAndIsWrongFromOneInAHundredOn) {
  EXPECT_EQ(RoundTripOf(0, 1e-3, 1e-3), kOk);
  EXPECT_EQ(RoundTripOf(1, 1e-3, 1e-3), kWarning);
  EXPECT_EQ(RoundTripOf(9, 1e-3, 1e-3), kWarning);
  EXPECT_EQ(RoundTripOf(10, 1e-3, 1e-3), kWrong);
  EXPECT_EQ(RoundTripOf(1000, 0, 0), kWrong);
}

TEST(RoundTripCheckTest, WarnsOfAPeriodAndIsWrongFromTenOnOrIfTheMotorsWouldDamp) {
  EXPECT_EQ(RoundTripOf(0, 2e-3, 0.1), kOk);
  EXPECT_EQ(RoundTripOf(0, 2.1e-3, 0.1), kWarning);
  EXPECT_EQ(RoundTripOf(0, 20e-3, 0.1), kWarning);
  EXPECT_EQ(RoundTripOf(0, 20.1e-3, 0.1), kWrong);
  EXPECT_EQ(RoundTripOf(0, 1e-3, 0.2), kOk);
  EXPECT_EQ(RoundTripOf(0, 1e-3, 0.21), kWrong);
}

TEST(MachineCheckTest, WarnsOfEachThingThatMakesLoopsLateAndCallsNoneWrong) {
  const auto expect_warning = [](const char* check, auto&& change) {
    EXPECT_EQ(VerdictOf(check, But(change)), kWarning) << check;
  };
  expect_warning("buffers", [](Measurements& seen) { --*seen.receive_buffer; });
  expect_warning("buffers", [](Measurements& seen) { --*seen.send_buffer; });
  expect_warning("dropped", [](Measurements& seen) { seen.dropped->buffer_full = 1; });
  expect_warning("dropped", [](Measurements& seen) { seen.dropped->interface_errors = 1; });
  expect_warning("dropped", [](Measurements& seen) { seen.dropped->interface_dropped = 1; });
  expect_warning("real-time", [](Measurements& seen) { seen.rights->fifo = false; });
  expect_warning("memory", [](Measurements& seen) { seen.rights->locked = false; });
  expect_warning("governor", [](Measurements& seen) {
    seen.governors = {"performance", "powersave"};
  });
  expect_warning("load", [](Measurements& seen) { seen.load = 2.1; });
  expect_warning("wakings", [](Measurements& seen) { seen.lateness.p99 = 1.1e-3; });
  expect_warning("clock source", [](Measurements& seen) { seen.clock_source = "hpet"; });
  expect_warning("clock sync", [](Measurements& seen) { seen.sync->synchronised = false; });
}

TEST(MachineCheckTest, SaysWhichSettingGivesTheBuffer) {
  EXPECT_THAT(
      FindingOf("buffers", But([](Measurements& seen) { seen.receive_buffer = 425984; })).remedy,
      HasSubstr("net.core.rmem_max=1048576"));
}

TEST(ClockCheckTest, IsWrongIfTheClockJumpsAndNeedsNoDaemonOnOneMachine) {
  const Finding jump = FindingOf(
      "clock steps", But([](Measurements& seen) { seen.clock = {.steps = 2, .largest = -0.25}; }));
  EXPECT_EQ(jump.verdict, kWrong);
  EXPECT_THAT(jump.text, HasSubstr("2 times, by -0.250 s"));
  EXPECT_EQ(VerdictOf("clock sync", But([](Measurements& seen) {
                        seen.sync->synchronised = false;
                        seen.link->loopback = true;
                      })),
            kOk);
}

TEST(ClockCheckTest, WarnsOfAPeersClockThatIsAPeriodApartBeyondTheError) {
  const auto apart = [](double ahead, double error) {
    return VerdictOf("clock offset", But([&](Measurements& seen) {
                       seen.peer->offset = ClockOffset{.ahead = ahead, .error = error};
                     }));
  };
  EXPECT_EQ(apart(2e-3, 0), kOk);
  EXPECT_EQ(apart(-3e-3, 0), kWarning);
  EXPECT_EQ(apart(3e-3, 1.1e-3), kOk);
  EXPECT_EQ(VerdictOf("clock offset", But([](Measurements& seen) { seen.peer->offset.reset(); })),
            kNotSeen);
}

}  // namespace
}  // namespace understudy::doctor
