#include "record/output_file.h"

#include <csignal>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "base/unique_fd.h"
#include "tests/record/mcap_files.h"

namespace understudy::record {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class OutputFileTest : public McapFilesTest {};

TEST_F(OutputFileTest, DoesNotReplaceAFileUnasked) {
  folder_.Write("run.mcap", "precious");
  EXPECT_THAT([&] { OutputFile(File(), false); },
              ThrowsMessage<RecordError>(HasSubstr("exists already; name another file, or "
                                                   "replace it with --overwrite")));
  EXPECT_EQ(FileText(File()), "precious");
}

TEST_F(OutputFileTest, ReplacesAFileWhenAsked) {
  folder_.Write("run.mcap", "a long text that goes");
  OutputFile file(File(), true);
  file.Write(AsBytes("new"));
  EXPECT_EQ(FileText(File()), "new");
  EXPECT_EQ(file.size(), 3U);
}

TEST_F(OutputFileTest, WritesThroughALinkOnlyIfThoseAreFollowed) {
  const auto precious = folder_.Write("precious.txt", "precious");
  std::filesystem::create_symlink(precious, File());
  EXPECT_THAT([&] { OutputFile(File(), true, Links::kRefused); },
              ThrowsMessage<RecordError>(HasSubstr("is a link; name the file itself")));
  EXPECT_EQ(FileText(precious), "precious");
  OutputFile(File(), true).Write(AsBytes("new"));
  EXPECT_EQ(FileText(precious), "new");
}

TEST_F(OutputFileTest, DoesNotReplaceWhatIsBeingWritten) {
  OutputFile first(File(), false);
  first.Write(AsBytes("precious"));
  EXPECT_THAT([&] { OutputFile(File(), true); },
              ThrowsMessage<RecordError>(HasSubstr("another run is writing it")));
  EXPECT_EQ(FileText(File()), "precious");
}

TEST_F(OutputFileTest, IsNoPipeAndDoesNotWaitForItsReader) {
  const std::string pipe = File("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto is_refused = ThrowsMessage<RecordError>(HasSubstr("pipe: is not a file"));
  EXPECT_THAT([&] { OutputFile(pipe, true); }, is_refused);
  const UniqueFd reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK));
  EXPECT_THAT([&] { OutputFile(pipe, true); }, is_refused);
}

TEST_F(OutputFileTest, NamesAFolderThatIsNotThere) {
  EXPECT_THAT([&] { OutputFile(File("none/run.mcap"), false); },
              ThrowsMessage<RecordError>(HasSubstr("No such file or directory")));
}

TEST_F(OutputFileTest, SaysThatADiskIsFull) {
  OutputFile full("/dev/full", true);
  EXPECT_THAT([&] { full.Write(AsBytes("words")); },
              ThrowsMessage<RecordError>(HasSubstr("/dev/full: cannot be written: No space left")));
}

TEST_F(OutputFileTest, CutsOffWhatDidNotFit) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit few{.rlim_cur = 100, .rlim_max = before.rlim_max};
  OutputFile file(File(), false);
  file.Write(AsBytes(std::string(60, 'a')));
  setrlimit(RLIMIT_FSIZE, &few);
  EXPECT_THAT([&] { file.Write(AsBytes(std::string(60, 'b'))); },
              ThrowsMessage<RecordError>(HasSubstr("File too large")));
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(FileText(File()), std::string(60, 'a'));
}

}  // namespace
}  // namespace understudy::record
