// Every way to wait, of C and C++, ends at its simulated instant. tests/simclock/waits.cc has them.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "own_clock.h"

namespace understudy::simclock {
namespace {

std::vector<std::string> Ways() {
  const std::unique_ptr<FILE, int (*)(FILE*)> list(::popen(UNDERSTUDY_WAITS, "r"), &::pclose);
  std::vector<std::string> names;
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), list.get()));
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
    names.push_back(text.substr(at, end - at));
  }
  return names;
}

class WaitsTest : public testing::TestWithParam<bool> {};

TEST_P(WaitsTest, EveryWaitEndsAtItsSimulatedInstant) {
  const std::vector<std::string> ways = Ways();
  ASSERT_GT(ways.size(), 40U);
  for (const std::string& way : ways) {
    const test::ClockedRun run =
        test::RunOnClock({UNDERSTUDY_WAITS, way}, {.realtime = GetParam()});
    EXPECT_EQ(run.code, 0) << way << ": " << run.printed << " s, in " << run.wall << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(LookingAndFifo, WaitsTest, testing::Bool());

}  // namespace
}  // namespace understudy::simclock
