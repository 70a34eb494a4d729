#include "viewer/film_command.h"

#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/errors.h"
#include "base/files.h"
#include "base/progress_bar.h"
#include "viewer/film_maker.h"
#include "viewer/headless_gl.h"
#include "viewer/live_robot.h"
#include "viewer/recorded_states.h"
#include "viewer/video_file.h"

namespace understudy::viewer {
namespace {

constexpr int kMostHz = 240;                         // that a robot sends snapshots at
constexpr std::chrono::milliseconds kStopLook{200};  // between looks at the stop flag
constexpr std::chrono::seconds kStandstill{2};       // until it is said that time stands still

// The output. It creates the file with the first picture, so that no empty file appears.
class Output {
 public:
  explicit Output(const FilmArguments& arguments) : arguments_(arguments) {
    const PictureSize& size = arguments.drawing.size;
    if (size.width % 2 != 0 || size.height % 2 != 0) {
      throw SetupError("--size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                       ": a film is an even number of pixels wide and high");
    }
    file_.emplace(arguments.drawing.out, size, arguments.fps);
  }

  void Add(const Image& image) {
    file_->Add(image);
    ++pictures_;
  }

  // Reports the result. A film without pictures is an error.
  void Finish() {
    if (pictures_ == 0) throw SetupError("nothing was filmed");
    file_->Finish();
    std::fprintf(stderr, "%s: %d pictures, %.1f s\n", arguments_.drawing.out.c_str(), pictures_,
                 static_cast<double>(pictures_) / arguments_.fps);
  }

 private:
  const FilmArguments& arguments_;
  std::optional<VideoFile> file_;
  int pictures_ = 0;
};

FilmMaker MakeFilmMaker(const FilmArguments& arguments, double simulated, Stage* stage,
                        Output* output) {
  const DrawingArguments& drawing = arguments.drawing;
  return {stage,
          drawing.camera,
          drawing.show,
          drawing.size,
          {.fps = arguments.fps,
           .speed = arguments.speed,
           .orbit = arguments.orbit,
           .seconds = simulated / arguments.speed,
           .plain = arguments.plain},
          [output](const Image& image) { output->Add(image); }};
}

void FilmRobot(const FilmArguments& arguments, const std::function<bool()>& should_stop) {
  const std::filesystem::path socket = client::ChosenSocket(arguments.drawing.robot);
  Stage stage(FetchModel(socket), FetchName(socket));
  const auto gl = MakeHeadlessGl(arguments.drawing.gl);
  Output output(arguments);
  const double whole = arguments.seconds / arguments.speed;
  FilmMaker maker = MakeFilmMaker(arguments, arguments.seconds, &stage, &output);
  // Twice as many states as pictures, so that interpolation is accurate.
  const int hz = static_cast<int>(std::lround(2 * arguments.fps / arguments.speed));
  LiveRobot robot(socket, std::clamp(hz, 1, kMostHz), stage.positions());
  LiveEvents events(socket);
  {
    ProgressBar bar(std::filesystem::path(arguments.drawing.out).filename().string());
    auto moved = std::chrono::steady_clock::now();
    double newest = -1;
    for (bool more = true; more && !should_stop();) {
      const std::deque<SceneState> states = robot.Take(kStopLook);
      if (!arguments.plain) {
        for (FilmEvent& event : events.News()) maker.Tell(std::move(event));
      }
      for (const SceneState& state : states) {
        if (state.time != newest) moved = std::chrono::steady_clock::now();
        newest = state.time;
        more = maker.Add(state);
        bar.Show(maker.seconds(), whole);
        if (!more || should_stop()) break;
      }
      const bool stands = std::chrono::steady_clock::now() - moved > kStandstill;
      bar.Show(maker.seconds(), whole, stands ? "waiting: the robot is paused" : "");
      if (const std::string why = robot.gone(); more && !why.empty()) {
        std::fprintf(stderr, "understudy: the film ends early: %s\n", why.c_str());
        break;
      }
    }
  }
  output.Finish();
}

void FilmRecording(const FilmArguments& arguments, const std::function<bool()>& should_stop) {
  const RecordedStates recording(arguments.drawing.recording);
  const RecordedStates::Span span = recording.Cut(arguments.from, arguments.to);
  Stage stage(recording.ReadModel(), recording.robot());
  const auto gl = MakeHeadlessGl(arguments.drawing.gl);
  Output output(arguments);
  FilmMaker maker = MakeFilmMaker(arguments, span.to - span.from, &stage, &output);
  {
    ProgressBar bar(std::filesystem::path(arguments.drawing.out).filename().string());
    recording.Read(
        span, stage.positions(),
        [&](const SceneState& state) {
          const bool more = maker.Add(state) && !should_stop();
          bar.Show(maker.seconds(), (span.to - span.from) / arguments.speed);
          return more;
        },
        [&](FilmEvent event) { maker.Tell(std::move(event)); }, kEventShown * arguments.speed);
  }
  output.Finish();
}

}  // namespace

void Film(const FilmArguments& arguments, const std::function<bool()>& should_stop) {
  CheckWritable(arguments.drawing.out, arguments.drawing.overwrite);
  if (arguments.drawing.recording.empty()) {
    FilmRobot(arguments, should_stop);
  } else {
    FilmRecording(arguments, should_stop);
  }
}

}  // namespace understudy::viewer
