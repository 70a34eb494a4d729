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

#include "base/errors.h"
#include "base/files.h"
#include "exec/companion_file.h"
#include "mjcf/join.h"
#include "rehearse/lidar_view.h"

namespace understudy::commands {
namespace {

namespace fs = std::filesystem;

// All *assumed*.
constexpr std::size_t kMostPictures = 4;
constexpr char kSize[] = "480x300";

struct Instant {
  double at = 0;          // s
  std::size_t robot = 0;  // its number
  bool first = false;     // of the first expectation that failed, or of the first
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
      instants.push_back(
          {.at = at, .robot = expect.signals[signal].robot, .first = instants.empty()});
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

// Draws one recording by `understudy picture`.
class Painter {
 public:
  explicit Painter(const fs::path& folder)
      : viewer_(exec::CompanionFile("understudy-view")), file_(folder / "picture.png") {
    std::error_code ignored;
    if (!fs::exists(viewer_, ignored))
      why_not_ = "understudy-view, which draws them, is not installed";
  }
  ~Painter() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // Returns the file of a picture, by a camera of the robot's if one is named; "" if it cannot be
  // drawn. After that it draws no more.
  std::string Draw(const fs::path& recording, double at, const std::string& camera = "") {
    if (!why_not_.empty()) return {};
    std::vector<std::string> words{viewer_, "picture",  file_,    "--recording", recording,
                                   "--at",  Digits(at), "--size", kSize,         "--overwrite"};
    if (!camera.empty()) words.insert(words.end(), {"--camera", camera});
    if (Succeeds(words)) return FileText(file_);
    why_not_ = "understudy picture could not draw the recording";
    return {};
  }
  const std::string& why_not() const { return why_not_; }

 private:
  fs::path viewer_, file_;
  std::string why_not_;
};

}  // namespace

rehearse::Pictures DrawPictures(const rehearse::Expectations& expect,
                                const rehearse::Judged& judged, const config::Config& config,
                                const std::vector<fs::path>& recordings, const fs::path& folder) {
  rehearse::Pictures pictures;
  Painter painter(folder);
  for (const auto& [when, robot, first] : InstantsOf(expect, judged)) {
    const double at = std::min(when, judged.end);
    const fs::path& recording = recordings[robot];
    const config::RobotConfig& of = config.robots[robot];
    rehearse::Pictures::Picture picture{.at = when, .png = painter.Draw(recording, at)};
    if (first && !of.spec.cameras.empty()) {  // a picture takes a second
      picture.camera = of.spec.cameras.front().name;
      picture.seen_png = painter.Draw(recording, at, picture.camera);
    }
    try {
      const robot::RobotSpec spec = mjcf::WithPrefix(config.PrefixOf(of), of.spec);
      const auto view = rehearse::ReadLidarView(recording, spec, at);
      if (!view.empty()) picture.lidar = rehearse::DrawLidarView(view);
    } catch (const SetupError& error) {
      pictures.why_not = error.what();
    }
    if (!picture.png.empty() || !picture.lidar.empty()) pictures.drawn.push_back(picture);
  }
  if (pictures.why_not.empty()) pictures.why_not = painter.why_not();
  return pictures;
}

}  // namespace understudy::commands
