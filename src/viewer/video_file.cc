#include "viewer/video_file.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "viewer/film_formats.h"

namespace understudy::viewer {
namespace {

// ffmpeg's command line, reading raw pictures from its standard input.
std::vector<std::string> Arguments(const PictureSize& size, int fps, const FilmFormat& format,
                                   const std::string& out) {
  const std::string pixels = std::to_string(size.width) + "x" + std::to_string(size.height);
  std::vector<std::string> arguments = {"ffmpeg", "-nostdin", "-loglevel",  "error",
                                        "-f",     "rawvideo", "-pix_fmt",   "rgb24",
                                        "-s",     pixels,     "-framerate", std::to_string(fps),
                                        "-i",     "pipe:0",   "-an"};
  std::istringstream options{std::string(format.options)};
  arguments.insert(arguments.end(), std::istream_iterator<std::string>(options), {});
  arguments.insert(arguments.end(),
                   {"-y", "file:" + out});  // even if the name looks like a protocol's
  return arguments;
}

// ", or name a film .mp4 or .gif": the kinds that are left.
std::string OtherEndings(const std::string& ending) {
  std::string others;
  for (const FilmFormat& format : kFilmFormats) {
    if (format.ending != ending)
      others += (others.empty() ? "" : " or ") + std::string(format.ending);
  }
  return ", or name a film " + others;
}

}  // namespace

VideoFile::VideoFile(std::filesystem::path file, const PictureSize& size, int fps)
    : file_(std::move(file)), part_(file_.string() + "." + std::to_string(::getpid()) + ".part") {
  const FilmFormat* const format = FindFilmFormat(file_);
  if (format == nullptr) throw SetupError(file_.string() + ": no kind of film ends like this");
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw SetupError(std::string("no pipe for ffmpeg: ") + std::generic_category().message(errno));
  }
  const UniqueFd reading(ends[0]);
  pictures_ = UniqueFd(ends[1]);
  words_ = UniqueFd(::memfd_create("ffmpeg", MFD_CLOEXEC));

  std::vector<std::string> texts = Arguments(size, fps, *format, part_.string());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, reading.get(), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, words_.get(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A separate process group: Ctrl-C reaches only us, and we then end ffmpeg's input.
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int error = ::posix_spawnp(&pid_, "ffmpeg", &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    pid_ = -1;
    throw SetupError("films are made by ffmpeg, and it cannot be run: " +
                     std::generic_category().message(error) + "; apt-get install ffmpeg");
  }
}

VideoFile::~VideoFile() {
  if (pid_ < 0) return;
  pictures_.reset();
  ::kill(pid_, SIGKILL);
  Wait();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void VideoFile::Add(const Image& image) {
  const std::uint8_t* next = image.rgb.data();
  std::size_t left = image.rgb.size();
  while (left > 0) {
    const ssize_t wrote = ::write(pictures_.get(), next, left);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) Fail();
    next += wrote;
    left -= static_cast<std::size_t>(wrote);
  }
}

void VideoFile::Finish() {
  pictures_.reset();
  // For a full disk it prints "error" but may exit with 0.
  if (Wait() != 0 || !Said().empty()) Fail();
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  throw SetupError("cannot write " + file_.string() + ": " + error.message());
}

int VideoFile::Wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return status;
}

std::string VideoFile::Said() const {
  std::array<char, 512> text{};
  const ssize_t read = ::pread(words_.get(), text.data(), text.size(), 0);
  const std::string said(text.data(), static_cast<std::size_t>(read > 0 ? read : 0));
  return said.substr(0, said.find('\n'));
}

void VideoFile::Fail() {
  pictures_.reset();
  if (pid_ >= 0) Wait();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  const std::string why = Said();
  if (why.find("Unknown encoder") != std::string::npos) {
    throw SetupError("cannot write " + file_.string() + ": this ffmpeg has no encoder for " +
                     EndingOf(file_) + " (it says: " + why +
                     "); Debian's has, apt-get install ffmpeg" + OtherEndings(EndingOf(file_)));
  }
  throw SetupError("cannot write " + file_.string() + ": ffmpeg " +
                   (why.empty() ? "ended without a word" : "says: " + why));
}

}  // namespace understudy::viewer
