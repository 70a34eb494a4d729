#include "server/request_docs.h"

#include <fstream>
#include <iterator>

#include "gtest/gtest.h"

namespace understudy::server {
namespace {

TEST(RequestsReferenceTest, IsWhatDocsRequestsMdHas) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/requests.md", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(text, RequestsReference())
      << "write it anew: understudy requests > docs/reference/requests.md";
}

}  // namespace
}  // namespace understudy::server
