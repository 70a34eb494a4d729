#include "viewer/arguments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <system_error>

#include <CLI/CLI.hpp>

#include "base/nearest_word.h"
#include "ctl/check.h"
#include "viewer/film_formats.h"

namespace understudy::viewer {
namespace {

constexpr double kLongest = 86'400;  // s of film: a day
constexpr double kLongestRun = 1e9;  // s; a recording says where it ends
constexpr int kSmallest = 16;        // pixels
constexpr int kLargest = 4096;       // drawn at twice that, within what every OpenGL here takes

struct ShowWord {
  const char* word;
  bool ShowChoice::*flag;
};
constexpr std::array<ShowWord, 5> kShown = {{{"contacts", &ShowChoice::contacts},
                                             {"forces", &ShowChoice::forces},
                                             {"com", &ShowChoice::com},
                                             {"joints", &ShowChoice::joints},
                                             {"collision", &ShowChoice::collision}}};

std::optional<PictureSize> ReadSize(const std::string& text) {
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  if (height.ec != std::errc() || height.ptr != end) return std::nullopt;
  for (const int side : {size.width, size.height}) {
    if (side < kSmallest || side > kLargest) return std::nullopt;
  }
  return size;
}

template <class Number>
CLI::Option* AddNumber(CLI::App* command, const char* option, Number* value, const char* help,
                       double least, double most, const char* type) {
  return command->add_option(option, *value, help)
      ->check(ctl::NumberWithin(least, most))
      ->type_name(type);
}

void AddSize(CLI::App* command, PictureSize* size, const char* what) {
  command
      ->add_option_function<std::string>(
          "--size", [size](const std::string& text) { *size = *ReadSize(text); }, what)
      ->type_name("WxH")
      ->check([](const std::string& text) {
        return ReadSize(text) ? std::string()
                              : "expected WIDTHxHEIGHT in pixels, each from 16 to 4096, as in "
                                "1280x720; got " +
                                    text;
      });
}

void AddCamera(CLI::App* command, CameraChoice* camera) {
  CLI::Option* name =
      command->add_option("--camera", camera->name, "A camera of the model, by name");
  AddNumber(command, "--azimuth", &camera->azimuth,
            "Degrees; 0 looks along x, 90 along y [135, or 45 over ground that is not flat]", -3600,
            3600, "X")
      ->excludes(name);
  AddNumber(command, "--elevation", &camera->elevation, "Degrees; negative looks down [-18]", -90,
            90, "X")
      ->excludes(name);
  AddNumber(command, "--distance", &camera->distance,
            "Distance from what is looked at, m [so that the robot fills the picture]", 0.01, 1000,
            "X")
      ->excludes(name);
  CLI::Option* lookat =
      command->add_option("--lookat", camera->lookat, "X Y Z: a point of the world to look at, m")
          ->expected(3)
          ->check(ctl::NumberWithin(-1e4, 1e4))
          ->type_name("X")
          ->excludes(name);
  command->add_option("--track", camera->track, "A body to look at and follow [the robot]")
      ->type_name("BODY")
      ->excludes(name)
      ->excludes(lookat);
}

// What is wrong with words joined by commas, "" for nothing; sets what they name where `show` is
// not null.
std::string ReadShow(const std::string& text, ShowChoice* show) {
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    const auto row = std::find_if(kShown.begin(), kShown.end(),
                                  [&](const ShowWord& shown) { return word == shown.word; });
    if (row == kShown.end()) {
      std::vector<std::string> known;
      for (const ShowWord& shown : kShown) known.emplace_back(shown.word);
      return "nothing called '" + word + "' can be shown" + DidYouMean(word, known);
    }
    if (show != nullptr) show->*row->flag = true;
  }
  return {};
}

void AddShow(CLI::App* command, ShowChoice* show) {
  command
      ->add_option_function<std::string>(
          "--show", [show](const std::string& text) { ReadShow(text, show); },
          "Any of contacts, forces, com, joints, collision, joined by commas")
      ->type_name("WHAT")
      ->check([](const std::string& text) { return ReadShow(text, nullptr); });
}

// A name that ends in one of `endings`.
CLI::Validator Ending(const std::vector<std::string>& endings) {
  return {[endings](std::string& text) {
            const std::string found = EndingOf(text);
            for (const std::string& ending : endings) {
              if (found == ending) return std::string();
            }
            return "expected a name that ends in " + CLI::detail::join(endings, " or ") + ", got " +
                   text;
          },
          ""};
}

void AddDrawing(CLI::App* command, DrawingArguments* drawing,
                const std::vector<std::string>& endings) {
  command->add_option("out", drawing->out, "File to write")
      ->required()
      ->type_name("OUT" + endings.front())
      ->check(Ending(endings));
  client::AddRobotChoice(command, &drawing->robot);
  command
      ->add_option("--recording", drawing->recording,
                   "Draw this MCAP file of `understudy run --record` instead of a running robot")
      ->type_name("FILE")
      ->excludes("--name")
      ->excludes("--socket");
  AddSize(command, &drawing->size, "Pixels [1280x720]");
  AddCamera(command, &drawing->camera);
  AddShow(command, &drawing->show);
  command->add_flag("--overwrite", drawing->overwrite, "Replace the file that is there");
  command
      ->add_option("--gl", drawing->gl,
                   "Which OpenGL draws it: egl or osmesa [the first that works]")
      ->check(CLI::IsMember({"egl", "osmesa"}))
      ->type_name("WHICH");
}

}  // namespace

CLI::App* AddViewCommand(CLI::App* app, ViewArguments* arguments) {
  CLI::App* view = app->add_subcommand("view", "Look at a running robot in a window, and push it");
  client::AddRobotChoice(view, &arguments->robot);
  AddSize(view, &arguments->size, "Size of the window [1280x720]");
  AddCamera(view, &arguments->camera);
  AddShow(view, &arguments->show);
  view->footer(
      "Examples:\n"
      "  understudy view                         the only robot that runs\n"
      "  understudy view --name left --show forces\n"
      "  understudy run go2 --view               a robot and its window\n"
      "F1 in the window lists its keys. The robot runs on when the window is closed.");
  return view;
}

CLI::App* AddPictureCommand(CLI::App* app, PictureArguments* arguments) {
  CLI::App* picture = app->add_subcommand(
      "picture", "Draw a picture of a running robot, or of a recording; needs no display");
  AddDrawing(picture, &arguments->drawing, {".png"});
  AddNumber(picture, "--at", &arguments->at, "Second of simulated time in the recording [its end]",
            0, kLongestRun, "S")
      ->needs("--recording");
  picture->footer(
      "Examples:\n"
      "  understudy picture go2.png\n"
      "  understudy picture feet.png --track FR_calf --distance 0.6 --show contacts,forces\n"
      "  understudy picture fall.png --recording run.mcap --at 12.5 --size 1920x1080");
  return picture;
}

CLI::App* AddFilmCommand(CLI::App* app, FilmArguments* arguments) {
  CLI::App* film = app->add_subcommand(
      "film", "Film a running robot, or a recording, through ffmpeg; needs no display");
  std::vector<std::string> endings;
  for (const FilmFormat& format : kFilmFormats) endings.emplace_back(format.ending);
  AddDrawing(film, &arguments->drawing, endings);
  AddNumber(film, "--seconds", &arguments->seconds,
            "Simulated seconds of a running robot to film [10]", 0.1, kLongest, "S")
      ->excludes("--recording");
  AddNumber(film, "--from", &arguments->from, "Second of the recording to begin at [its beginning]",
            0, kLongestRun, "S")
      ->needs("--recording");
  AddNumber(film, "--to", &arguments->to, "Second of the recording to end at [its end]", 0,
            kLongestRun, "S")
      ->needs("--recording");
  AddNumber(film, "--fps", &arguments->fps, "Frames per second of the film [30]", 1, 120, "N");
  AddNumber(film, "--speed", &arguments->speed,
            "Simulated seconds per second of the film; 0.25 is slow motion [1]", 0.01, 100, "X");
  AddNumber(film, "--orbit", &arguments->orbit,
            "Degrees per second at which the camera moves round what it looks at [0]", -360, 360,
            "X")
      ->excludes("--camera");
  film->add_flag("--plain", arguments->plain, "Draw no clock and no events");
  film->footer(
      "Examples:\n"
      "  understudy film go2.mp4 --seconds 5\n"
      "  understudy film go2.webp --size 480x270 --fps 15    .webp and .gif for a page\n"
      "  understudy film slow.mp4 --recording run.mcap --from 10 --to 10.4 --speed 0.1 --fps 60\n"
      "The picture shows the simulated time and the last events; --plain leaves them out.\n"
      "Ctrl-C ends the film early; what has been filmed until then can be played.");
  return film;
}

}  // namespace understudy::viewer
