#include "doctor/report.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "healthy.h"

namespace understudy::doctor {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Measurements Down() {
  return But([](Measurements& seen) { seen.link->up = false; });
}

TEST(ReportTest, HasALineForEachCheckInColumnsAndCountsThem) {
  const std::string text = ReportText(Judge(Down()));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), Checks().size() + 1);
  EXPECT_THAT(
      text, HasSubstr("wrong     interface        eth0 is down -> as root: ip link set eth0 up\n"));
  EXPECT_THAT(text, HasSubstr("\nok        address          192"));
  EXPECT_THAT(text, EndsWith("1 wrong, 0 warnings, 26 ok, 1 not seen\n"));
}

TEST(ReportTest, IsOneDocumentForPrograms) {
  Measurements seen = Down();
  seen.peer->who = "\xFF";
  const auto report = nlohmann::json::parse(ReportJson(seen.question, Judge(seen)));
  EXPECT_EQ(report["wrong"], 1);
  EXPECT_EQ(report["interface"], "eth0");
  ASSERT_EQ(report["checks"].size(), Checks().size());
  EXPECT_EQ(report["checks"][0]["verdict"], "wrong");
  for (const auto& check : report["checks"]) {
    if (check["name"] == "round trip") {
      EXPECT_EQ(check["figures"]["p99"], 5e-4);
    }
  }
}

TEST(ReportTest, IsWrongIfAFindingIsAndNotForAWarning) {
  EXPECT_TRUE(AnyWrong(Judge(Down())));
  EXPECT_FALSE(AnyWrong(Judge(But([](Measurements& seen) { seen.load = 99; }))));
}

TEST(ReportTest, IsExplainedRowByRowInTheDocumentation) {
  std::ifstream stream(UNDERSTUDY_SOURCE_DIR "/docs/reference/doctor.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  std::size_t at = 0;
  for (const Check& check : Checks()) {
    const std::string row =
        "\n| " + std::string(check.name) + " | " + std::string(check.looks_at) + " | ";
    const std::size_t found = page.find(row, at);
    ASSERT_NE(found, std::string::npos) << row << "is missing, or not in its place";
    at = found;
  }
}

}  // namespace
}  // namespace understudy::doctor
