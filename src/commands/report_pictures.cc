#include "commands/report_pictures.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files.h"
#include "exec/companion_file.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

// All *assumed*.
constexpr std::size_t kMostPictures = 4;
constexpr char kSize[] = "480x300";

struct Instant {
  double at = 0;          // s
  std::size_t robot = 0;  // its number
};

// The instants that decided, each once, ascending.
std::vector<Instant> InstantsOf(const rehearse::Expectations& expect,
                                const rehearse::Judged& judged) {
  std::vector<Instant> instants;
  for (const auto outcome : {judge::Outcome::kFailed, judge::Outcome::kPassed}) {
    for (std::size_t i = 0; i < judged.rulings.size(); ++i) {
      const rehearse::Ruling& ruling = judged.rulings[i];
      if (ruling.verdict.outcome != outcome || !ruling.why.empty()) continue;
      const double at = rehearse::SecondsOf(ruling.verdict.worth.at);
      const bool known = std::ranges::any_of(instants, [at](const Instant& other) {
        return std::abs(at - other.at) < rehearse::kPicturesApart;
      });
      if (known || instants.size() == kMostPictures) continue;
      const std::size_t signal = expect.list[i].signals.front();
      instants.push_back({.at = at, .robot = expect.signals[signal].robot});
    }
  }
  std::ranges::sort(instants, std::ranges::less(), &Instant::at);
  return instants;
}

// Runs a program to its end, in silence. Threads may exist. Returns whether it exited with 0.
bool Succeeds(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
  }
  pid_t child = -1;
  const int error = ::posix_spawn(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return false;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string Digits(double number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.3f", number);
  return digits.data();
}

}  // namespace

rehearse::Pictures DrawPictures(const rehearse::Expectations& expect,
                                const rehearse::Judged& judged,
                                const std::vector<fs::path>& recordings, const fs::path& folder) {
  rehearse::Pictures pictures;
  const fs::path viewer = exec::CompanionFile("understudy-view");
  std::error_code ignored;
  if (!fs::exists(viewer, ignored)) {
    pictures.why_not = "understudy-view, which draws them, is not installed";
    return pictures;
  }
  const fs::path file = folder / "picture.png";
  for (const auto& [at, robot] : InstantsOf(expect, judged)) {
    const bool drawn = Succeeds({viewer, "picture", file, "--recording", recordings[robot], "--at",
                                 Digits(std::min(at, judged.end)), "--size", kSize, "--overwrite"});
    if (!drawn) {
      pictures.why_not = "understudy picture could not draw the recording";
      break;
    }
    pictures.drawn.push_back({.at = at, .png = FileText(file)});
  }
  fs::remove(file, ignored);
  return pictures;
}

}  // namespace understudy::commands
