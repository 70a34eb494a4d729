#include "simclock/own_page.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::simclock {
namespace {

constexpr char kPreload[] = "LD_PRELOAD";

[[noreturn]] void Fail(const std::string& what) {
  throw SetupError("--clock simulated: " + what + ": " + std::generic_category().message(errno));
}

std::filesystem::path LibraryFile() {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  return self.parent_path().parent_path() / "lib/understudy/preload/libsimclock.so";
}

std::string Variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// The descriptor that was given to this process; -1: none.
int FileOfStart() {
  const std::string given = Variable(kPageVariable);
  return given.empty() ? -1 : static_cast<int>(std::strtol(given.c_str(), nullptr, 10));
}

[[noreturn]] void StartAnew(const UniqueFd& page) {
  const std::string before = Variable(kPreload);
  const std::string library = LibraryFile().string();
  if (!std::filesystem::exists(library)) {
    throw SetupError("--clock simulated: there is no " + library + "; install Understudy again");
  }
  ::setenv(kPreload, before.empty() ? library.c_str() : (library + ":" + before).c_str(), 1);
  ::setenv(kPageVariable, std::to_string(page.get()).c_str(), 1);
  std::vector<std::string> words = OwnWords();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // By its own path: the process keeps its name.
  ::execv(std::filesystem::read_symlink("/proc/self/exe").c_str(), arguments.data());
  Fail("this program cannot be started anew");
}

}  // namespace

// Its number is one that shells and programs do not use for their own.
UniqueFd MakePage(std::chrono::nanoseconds think) {
  constexpr int kNumber = 900;  // *assumed*
  rlimit most{};
  ::getrlimit(RLIMIT_NOFILE, &most);
  const UniqueFd made(::memfd_create("understudy-clock", MFD_CLOEXEC));
  UniqueFd file(::fcntl(made.get(), F_DUPFD, std::min<rlim_t>(kNumber, most.rlim_cur / 2)));
  Page* const page = ::ftruncate(file.get(), sizeof(Page)) == 0 ? MapPage(file.get()) : nullptr;
  if (page == nullptr) Fail("no shared memory");
  page->magic = kMagic;
  page->version = kVersion;
  page->robot = ::getpid();
  page->signal = SIGRTMAX - 3;  // *assumed*: no program uses it
  page->core = std::max(0, ::sched_getcpu());
  page->think = think.count();
  page->now = kFirstInstant;
  ::munmap(page, sizeof(Page));
  return file;
}

Page* MapPage(int file) {
  void* const at = ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  return at == MAP_FAILED ? nullptr : static_cast<Page*>(at);
}

std::vector<std::string> OwnWords() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

std::optional<std::chrono::nanoseconds> MedianComputed(const Page& page) {
  std::uint64_t all = 0, sum = 0;
  for (const auto& count : page.computed) all += count;
  for (std::size_t span = 0; span < kSpans && all > 0; ++span) {
    sum += page.computed[span];
    if (2 * sum >= all) return std::chrono::nanoseconds(LeastOf(span));
  }
  return std::nullopt;
}

std::optional<std::chrono::nanoseconds> ThinkOfStart() {
  Page* const page = MapPage(FileOfStart());
  if (page == nullptr) return std::nullopt;
  const bool ours = page->robot == ::getpid();
  const std::chrono::nanoseconds think(page->think);
  ::munmap(page, sizeof(Page));
  return ours ? std::optional(think) : std::nullopt;
}

OwnPage::OwnPage(std::chrono::nanoseconds think) {
  if (const int file = FileOfStart(); file >= 0) Take(file);
  if (page_ == nullptr) StartAnew(MakePage(think));
}

OwnPage::~OwnPage() { ::munmap(page_, sizeof(Page)); }

// The variables are the program's: what else this process starts is on real time.
void OwnPage::Take(int file) {
  page_ = MapPage(file);
  if (page_ == nullptr || page_->robot != ::getpid()) {  // of another robot, whose program we are
    page_ = nullptr;
    return;
  }
  file_ = UniqueFd(file);
  const std::string preload = Variable(kPreload);
  environment_ = {{kPageVariable, std::to_string(file)}, {kPreload, preload}};
  ::unsetenv(kPageVariable);
  const std::size_t end = preload.find(':');
  if (end == std::string::npos) {
    ::unsetenv(kPreload);
  } else {
    ::setenv(kPreload, preload.c_str() + end + 1, 1);
  }
  if (page_->loaded == 0) {
    throw SetupError("--clock simulated: the loader did not load " + LibraryFile().string());
  }
}

}  // namespace understudy::simclock
