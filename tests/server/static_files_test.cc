#include "server/static_files.h"

#include <filesystem>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

namespace understudy::server {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Pair;

class StaticFilesTest : public ::testing::Test {
 protected:
  StaticFilesTest() {
    temp_.Write("secret.txt", "mine");
    temp_.Write("panel/index.html", "<html>");
    temp_.Write("panel/vendor/three.js", "export {}");
    temp_.Write("panel/.hidden", "mine");
  }
  unsigned StatusOf(std::string_view path) { return dut_.Get(path, "").status; }

  test::TemporaryFolder temp_;
  StaticFiles dut_{temp_.path() / "panel"};
};

TEST_F(StaticFilesTest, ServesAFileWithItsType) {
  const HttpReply page = dut_.Get("index.html", "");
  EXPECT_EQ(page.status, 200u);
  EXPECT_EQ(page.content(), "<html>");
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  EXPECT_EQ(dut_.Get("vendor/three.js", "").type, "text/javascript; charset=utf-8");
}

TEST_F(StaticFilesTest, APageMayLoadNothingFromElsewhere) {
  const HttpReply page = dut_.Get("index.html", "");
  EXPECT_THAT(page.fields,
              Contains(Pair("Content-Security-Policy", HasSubstr("script-src 'self'"))));
  EXPECT_THAT(page.fields, Contains(Pair("X-Content-Type-Options", "nosniff")));
}

TEST_F(StaticFilesTest, TellsAClientThatItHasTheFileAlready) {
  HttpReply page = dut_.Get("index.html", "");
  std::string tag;
  for (const auto& [name, value] : page.fields) {
    if (name == "ETag") tag = value;
  }
  EXPECT_EQ(dut_.Get("index.html", tag).status, 304u);
  EXPECT_EQ(dut_.Get("index.html", tag).content(), "");
  page = {};
  temp_.Write("panel/index.html", "<html>changed");
  EXPECT_EQ(dut_.Get("index.html", tag).content(), "<html>changed");
}

TEST_F(StaticFilesTest, OneCopyIsSentToAllWhoReadIt) {
  const HttpReply one = dut_.Get("index.html", "");
  EXPECT_EQ(dut_.Get("index.html", "").shared, one.shared);
}

TEST_F(StaticFilesTest, ServesNothingOutsideItsFolder) {
  for (const char* path :
       {"../secret.txt", "vendor/../../secret.txt", "/etc/passwd", "//etc/passwd", "..", ".",
        "./index.html", "vendor//three.js", "vendor/", "", "vendor", ".hidden", "vendor/.x",
        "%2e%2e/secret.txt", "..\\secret.txt", "index.html/", "a b"}) {
    EXPECT_EQ(StatusOf(path), 404u) << path;
  }
}

TEST_F(StaticFilesTest, FollowsNoLinkOutOfItsFolder) {
  std::filesystem::create_symlink(temp_.path() / "secret.txt", temp_.path() / "panel/link.txt");
  std::filesystem::create_symlink(temp_.path(), temp_.path() / "panel/up");
  EXPECT_EQ(StatusOf("link.txt"), 404u);
  EXPECT_EQ(StatusOf("up/secret.txt"), 404u);
}

TEST_F(StaticFilesTest, SaysThatThereIsNoPanel) {
  StaticFiles none(temp_.path() / "none");
  const HttpReply reply = none.Get("index.html", "");
  EXPECT_EQ(reply.status, 404u);
  EXPECT_THAT(reply.body, HasSubstr("no panel"));
}

}  // namespace
}  // namespace understudy::server
