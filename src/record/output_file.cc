#include "record/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace understudy::record {
namespace {

std::string Why() { return std::strerror(errno); }  // NOLINT(concurrency-mt-unsafe)

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, bool overwrite, Links links)
    : path_(std::move(path)) {
  const int flags = (overwrite ? 0 : O_EXCL) | (links == Links::kRefused ? O_NOFOLLOW : 0);
  // O_NONBLOCK: opening a pipe must not wait for its reader; without one the error is ENXIO.
  fd_ = UniqueFd(::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | flags, 0666));
  struct stat about {};
  if (fd_.valid() ? ::fstat(fd_.get(), &about) == 0 && S_ISFIFO(about.st_mode) : errno == ENXIO) {
    throw RecordError(path_.string() + ": is not a file");
  }
  if (!fd_.valid() && errno == ELOOP) {
    throw RecordError(path_.string() + ": is a link; name the file itself");
  }
  if (!fd_.valid() && errno == EEXIST) {
    throw RecordError(path_.string() +
                      ": exists already; name another file, or replace it with --overwrite");
  }
  if (!fd_.valid()) throw RecordError(path_.string() + ": cannot be written: " + Why());
  if (::flock(fd_.get(), LOCK_EX | LOCK_NB) != 0) {
    throw RecordError(path_.string() + ": another run is writing it");
  }
  // Fails for a device, which has nothing to truncate.
  static_cast<void>(::ftruncate(fd_.get(), 0));
}

void OutputFile::Write(ByteSpan bytes) {
  for (ByteSpan rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(fd_.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const std::string why = Why();
      static_cast<void>(::ftruncate(fd_.get(), static_cast<off_t>(size_)));
      throw RecordError(path_.string() + ": cannot be written: " + why);
    }
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  size_ += bytes.size();
}

}  // namespace understudy::record
