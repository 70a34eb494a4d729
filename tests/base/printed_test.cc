#include "base/printed.h"

#include <gtest/gtest.h>

namespace understudy {
namespace {

TEST(PrintedTest, IsWhatPrintfWritesHoweverLong) {
  EXPECT_EQ(Printed("%-4s|%.3f s, %zu", "ab", 1.0 / 3, std::size_t{7}), "ab  |0.333 s, 7");
  EXPECT_EQ(Printed("%s", ""), "");
  for (const int length : {254, 255, 256, 257, 5000}) {
    EXPECT_EQ(Printed("%*d", length, 1),
              std::string(static_cast<std::size_t>(length) - 1, ' ') + "1");
  }
}

}  // namespace
}  // namespace understudy
