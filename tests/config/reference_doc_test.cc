#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "config/reference.h"

namespace understudy::config {
namespace {

TEST(ConfigReferenceDocTest, IsWhatHelpConfigPrints) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/config.md", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, ConfigReference())
      << "write it anew: understudy run go2 --help-config > docs/reference/config.md";
}

}  // namespace
}  // namespace understudy::config
