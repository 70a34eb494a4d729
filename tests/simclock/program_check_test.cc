#include "simclock/program_check.h"

#include <filesystem>
#include <string>

#include <elf.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.h"

namespace understudy::simclock {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class ProgramCheckTest : public testing::Test {
 protected:
  std::string Why(const std::string& content) {
    return WhyNoClock(folder_.Write("program", content), "/usr/bin:/bin");
  }
  // A program of 64 bits without a loader.
  static std::string Elf(unsigned char bits = ELFCLASS64) {
    std::string file(sizeof(Elf64_Ehdr), '\0');
    file.replace(0, SELFMAG, ELFMAG);
    file[EI_CLASS] = static_cast<char>(bits);
    return file;
  }

  test::TemporaryFolder folder_;
};

TEST_F(ProgramCheckTest, AProgramOfTheSystemCanTakeTheClock) {
  EXPECT_THAT(WhyNoClock("/bin/sh", ""), IsEmpty());
  EXPECT_THAT(WhyNoClock("/usr/bin/env", ""), IsEmpty());
}

TEST_F(ProgramCheckTest, AScriptCanIfItsInterpreterCan) {
  EXPECT_THAT(Why("#!/bin/sh\nexit 0\n"), IsEmpty());
  EXPECT_THAT(Why("#! /usr/bin/env sh\nexit 0\n"), IsEmpty());
  EXPECT_THAT(Why("#!/no/such/interpreter\n"), HasSubstr("/no/such/interpreter: no such file"));
}

TEST_F(ProgramCheckTest, AStaticProgramCannot) {
  EXPECT_THAT(Why(Elf()), HasSubstr("is linked statically"));
}

TEST_F(ProgramCheckTest, AProgramOf32BitsCannot) {
  EXPECT_THAT(Why(Elf(ELFCLASS32)), HasSubstr("is a program of 32 bits"));
}

TEST_F(ProgramCheckTest, AProgramInGoCannot) {
  const std::string far(3 << 20, '\0');
  EXPECT_THAT(Why(Elf() + far + "\xff Go buildinf:"), HasSubstr("is written in Go"));
}

TEST_F(ProgramCheckTest, ASetUserIdProgramCannot) {
  const std::string file = folder_.Write("program", "#!/bin/sh\n");
  ASSERT_EQ(::chmod(file.c_str(), S_ISUID | 0755), 0);
  EXPECT_THAT(WhyNoClock(file, ""), HasSubstr("is set-user-id"));
}

TEST_F(ProgramCheckTest, ContainersAndRemoteShellsCannot) {
  EXPECT_THAT(WhyNoClock("/usr/bin/docker", ""), HasSubstr("starts the program elsewhere"));
  EXPECT_THAT(WhyNoClock("/usr/bin/ssh", ""), HasSubstr("starts the program elsewhere"));
}

}  // namespace
}  // namespace understudy::simclock
