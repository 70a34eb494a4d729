#include "robot/fault_docs.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

TEST(FaultsReferenceTest, IsWhatDocsFaultsMdHas) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/faults.md", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(text, FaultsReference())
      << "write it anew: understudy faults > docs/reference/faults.md";
}

}  // namespace
}  // namespace understudy::robot
