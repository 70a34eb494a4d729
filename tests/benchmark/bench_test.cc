// Checks that the benchmark prints its figures, not their values.
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace understudy::benchmark {
namespace {

using testing::Gt;
using testing::Lt;

std::string OutputOf(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  char part[4096];
  for (std::size_t n = 0; (n = std::fread(part, 1, sizeof(part), pipe)) > 0;) {
    output.append(part, n);
  }
  EXPECT_EQ(pclose(pipe), 0);
  return output;
}

TEST(BenchTest, GivesEachFigureOfEachRobot) {
  const auto figures = nlohmann::json::parse(OutputOf(BENCH " --brief --json")).at("figures");
  for (const std::string robot : {"go2", "g1"}) {
    for (const char* part : {"bare MuJoCo", "whole daemon", "daemon / bare", "round trip",
                             "LowCmd to LowState, p99", "memory"}) {
      EXPECT_THAT(figures, testing::Contains(testing::Truly([&](const nlohmann::json& figure) {
                    return figure.at("robot") == robot &&
                           figure.at("name").get<std::string>().starts_with(part);
                  })))
          << robot << ": " << part;
    }
  }
  EXPECT_THAT(figures, testing::Contains(testing::Truly([](const nlohmann::json& figure) {
                return figure.at("name") == "daemon / bare, hanging, hands inspire" &&
                       figure.at("at_least") == 0.85;
              })));
  for (const auto& figure : figures) {
    if (figure.at("name") == "messages lost") continue;
    if (figure.at("name").get<std::string>().starts_with("estimate of")) {
      EXPECT_LT(figure.at("measured"), 0.1) << figure;
    }
    EXPECT_THAT(figure.at("measured").get<double>(), testing::AllOf(Gt(0), Lt(1e7))) << figure;
  }
}

TEST(BenchTest, GivesTheSpeedOfRehearsalsOnItsOwn) {
  const auto figures =
      nlohmann::json::parse(OutputOf(BENCH " --rehearsals --brief --json")).at("figures");
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].at("at_least"), 15);
  EXPECT_GT(figures[1].at("measured"), 1);
}

TEST(BenchTest, GivesWhatRaysAndPicturesTake) {
  const auto figures = nlohmann::json::parse(OutputOf(BENCH " --perception --brief --json"))
                           .at("figures")
                           .get<std::vector<nlohmann::json>>();
  std::vector<double> wanted;
  for (const auto& figure : figures) {
    EXPECT_THAT(figure.at("measured").get<double>(), testing::AllOf(Gt(0), Lt(1e5))) << figure;
    if (figure.at("unit") == "/s") wanted.push_back(figure.at("at_least"));
  }
  EXPECT_THAT(wanted, testing::ElementsAre(14, 5));
}

TEST(BenchTest, GivesWhatABatchKeepsOfMujocosSpeed) {
  const auto figures = nlohmann::json::parse(OutputOf(BENCH " --batch --brief --json"))
                           .at("figures")
                           .get<std::vector<nlohmann::json>>();
  std::vector<double> shares;
  for (const auto& figure : figures) {
    EXPECT_THAT(figure.at("measured").get<double>(), testing::AllOf(Gt(0), Lt(1e7))) << figure;
    if (figure.at("name") == "batch, batch / bare MuJoCo per CPU") {
      shares.push_back(figure.at("at_least"));
      EXPECT_THAT(figure.at("measured").get<double>(), testing::AllOf(Gt(0.2), Lt(2))) << figure;
    }
  }
  EXPECT_THAT(shares, testing::ElementsAre(0.95, 0.92));
}

TEST(BenchTest, GivesWhatTheSimulatedClockKeepsToOnItsOwn) {
  const auto figures = nlohmann::json::parse(OutputOf(BENCH " --clock --brief --json"))
                           .at("figures")
                           .get<std::vector<nlohmann::json>>();
  std::vector<double> bounds;
  for (const auto& figure : figures) {
    bounds.push_back(figure.at("at_least"));
    EXPECT_THAT(figure.at("measured").get<double>(), testing::AllOf(testing::Ge(0), Lt(1000)))
        << figure;
  }
  EXPECT_THAT(bounds, testing::ElementsAre(15, 1, 1, 1, 8, 0.9));
  EXPECT_GT(figures.at(0).at("measured"), 0.1);
}

TEST(BenchTest, GivesTheSpeedOfAnyProgramOnTheSimulatedClock) {
  const auto figures =
      nlohmann::json::parse(OutputOf(BENCH " --clock --brief --json --times 3 -- sleep 30"))
          .at("figures");
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[0].at("at_least"), 3);
  EXPECT_GT(figures[0].at("measured"), 1);
}

TEST(BenchTest, GivesTheStartOfEveryRobotOnItsOwn) {
  const auto figures =
      nlohmann::json::parse(OutputOf(BENCH " --start --brief --json")).at("figures");
  std::set<std::string> robots;
  for (const auto& figure : figures) {
    EXPECT_EQ(figure.at("name"), "exec to first LowState at a client");
    EXPECT_EQ(figure.at("at_most"), 0.25);
    robots.insert(figure.at("robot"));
  }
  for (const auto& entry :
       std::filesystem::directory_iterator(UNDERSTUDY_SOURCE_DIR "/config/robots")) {
    EXPECT_TRUE(robots.contains(entry.path().stem())) << entry.path();
  }
}

TEST(BenchTest, SaysInATableWhatIsWanted) {
  EXPECT_THAT(OutputOf(BENCH " --start --brief"),
              testing::AllOf(testing::HasSubstr("wanted"), testing::HasSubstr("<= 0.25")));
}

TEST(BenchTest, ExplainsItself) {
  EXPECT_THAT(OutputOf(BENCH " --help"), testing::HasSubstr("--json"));
}

}  // namespace
}  // namespace understudy::benchmark
