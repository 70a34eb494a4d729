#include "base/files.h"

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

namespace understudy {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class FilesTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(FilesTest, WhatIsWrittenIsReadAgain) {
  const std::filesystem::path file = folder_.path() / "a.txt";
  WriteFile(file, "one\n");
  WriteFile(file, std::string("t\0o", 3));
  EXPECT_EQ(FileText(file), std::string("t\0o", 3));
}

TEST_F(FilesTest, WhereAFileGoesIsCheckedBeforehand) {
  const std::filesystem::path there = folder_.Write("a.png", "x");
  EXPECT_NO_THROW(CheckWritable(folder_.path() / "b.png", false));
  EXPECT_NO_THROW(CheckWritable(there, true));
  EXPECT_THAT([&] { CheckWritable(there, false); },
              ThrowsMessage<RecordError>(HasSubstr("--overwrite")));
  EXPECT_THAT([&] { CheckWritable(folder_.path(), true); },
              ThrowsMessage<SetupError>(HasSubstr("is a folder")));
  EXPECT_THAT([&] { CheckWritable(folder_.path() / "no" / "b.png", false); },
              ThrowsMessage<SetupError>(HasSubstr("no folder")));
  EXPECT_THAT([&] { CheckWritable("/dev/null", true); },
              ThrowsMessage<SetupError>(HasSubstr("is not a file")));
}

TEST_F(FilesTest, NothingIsReadWhereNothingIs) { EXPECT_EQ(FileText(folder_.path() / "none"), ""); }

TEST_F(FilesTest, WhatCannotBeWrittenIsLeftAsItWasAndLeavesNothing) {
  const std::filesystem::path file = folder_.path() / "a";
  std::filesystem::create_directory(file);
  EXPECT_THROW(WriteFile(file, "one"), SetupError);
  EXPECT_THROW(WriteFile(folder_.path() / "none" / "a", "one"), SetupError);
  EXPECT_TRUE(std::filesystem::is_directory(file));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

}  // namespace
}  // namespace understudy
