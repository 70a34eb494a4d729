#include "exec/command.h"

#include <cerrno>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace understudy::exec {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A folder of its own with a program in two/, and a file of the same name without x bit in one/.
class FindProgramTest : public ::testing::Test {
 protected:
  FindProgramTest() {
    for (const char* walk : {"one/walk", "two/walk"}) folder_.Write(walk, "#!/bin/sh\n");
    fs::permissions(root_ / "two/walk", fs::perms::owner_all);
    fs::create_directory(root_ / "one/folder");
  }

  std::string In(const char* name) const { return (root_ / name).string(); }

  int CodeOf(const std::string& name, const std::string& search_path) const {
    try {
      FindProgram(name, search_path);
    } catch (const CommandError& error) {
      return error.exit_code();
    }
    return 0;
  }

  const test::TemporaryFolder folder_;
  const fs::path& root_ = folder_.path();
};

TEST_F(FindProgramTest, TakesTheFirstExecutableOfThePath) {
  EXPECT_EQ(FindProgram("walk", In("one") + ":" + In("two")), In("two/walk"));
}

TEST_F(FindProgramTest, LeavesANameWithASlashAlone) {
  EXPECT_EQ(FindProgram(In("two/walk"), "/nowhere"), In("two/walk"));
}

TEST_F(FindProgramTest, TakesAnEmptyFolderForTheCurrentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(root_ / "two");
  EXPECT_EQ(FindProgram("walk", "/nowhere:"), "./walk");
  EXPECT_EQ(FindProgram("walk", ""), "./walk");
  fs::current_path(before);
}

TEST_F(FindProgramTest, AnswersNotFoundForAnUnknownName) {
  EXPECT_EQ(CodeOf("fly", In("one") + ":" + In("two")), kExitNotFound);
  EXPECT_EQ(CodeOf("", In("two")), kExitNotFound);
  EXPECT_EQ(CodeOf(In("two/fly"), ""), kExitNotFound);
}

TEST_F(FindProgramTest, AnswersNotExecutableForAPlainFile) {
  EXPECT_EQ(CodeOf("walk", In("one")), kExitNotExecutable);
  EXPECT_EQ(CodeOf(In("one/walk"), ""), kExitNotExecutable);
}

TEST_F(FindProgramTest, AnswersNotExecutableForAFolder) {
  EXPECT_EQ(CodeOf(In("one/folder"), ""), kExitNotExecutable);
}

TEST_F(FindProgramTest, AnswersNotFoundForAScriptWhoseInterpreterIsNotThere) {
  for (const char* first : {"#!/nowhere/interpreter\n", "#! /nowhere/interpreter -x\n"}) {
    folder_.Write("two/walk", first);
    EXPECT_EQ(CodeOf(In("two/walk"), ""), kExitNotFound);
    EXPECT_EQ(CodeOf("walk", In("two")), kExitNotFound);
  }
  for (const char* first : {"", "#", "#!", "#!/bin/sh -e\n",
                            "\x7f"
                            "ELF"}) {
    folder_.Write("two/walk", first);
    EXPECT_EQ(CodeOf(In("two/walk"), ""), 0) << first;
  }
}

TEST_F(FindProgramTest, NamesTheFileAndTheReason) {
  try {
    FindProgram("walk", In("one"));
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_THAT(error.what(), HasSubstr(In("one/walk")));
    EXPECT_THAT(error.what(), HasSubstr("Permission denied"));
  }
}

TEST(CommandTest, GivesTheExitCodesOfEnv) {
  EXPECT_EQ(ExitCodeOfFailedExec(ENOENT), 127);
  EXPECT_EQ(ExitCodeOfFailedExec(EACCES), 126);
  EXPECT_EQ(ExitCodeOfFailedExec(ENOEXEC), 126);
}

}  // namespace
}  // namespace understudy::exec
