// The command lines of `understudy view`, `picture` and `film`. Without OpenGL, since `understudy`
// parses them too, for --help and completions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/robot_choice.h"

namespace CLI {
class App;
}

namespace understudy::viewer {

struct PictureSize {
  int width = 1280;  // pixels
  int height = 720;
};

// The camera. Values that are not given are chosen so that the robot fills the picture.
struct CameraChoice {
  std::string name;                 // a camera of the model; "" for a free one
  std::optional<double> azimuth;    // degrees, as in MuJoCo's free camera: 0 looks along x
  std::optional<double> elevation;  // degrees, negative from above
  std::optional<double> distance;   // m
  std::vector<double> lookat;       // m, world: a fixed point; empty follows the robot
  std::string track;                // a body to follow; "" for the robot as a whole
  bool fixed() const { return !name.empty(); }
};

// What to draw besides the robot; kShown has the words.
struct ShowChoice {
  bool contacts = false;   // a disc at every contact
  bool forces = false;     // contact forces, pushes and the crane's pull
  bool com = false;        // the robot's centre of mass, and its foot point
  bool joints = false;     // joint axes
  bool collision = false;  // the collision shapes instead of the visible ones
};

struct ViewArguments {
  client::RobotChoice robot;
  PictureSize size;
  CameraChoice camera;
  ShowChoice show;
};

// Options of both picture and film.
struct DrawingArguments {
  std::string out;
  client::RobotChoice robot;
  std::string recording;  // an MCAP file; "" for a running robot
  PictureSize size;
  CameraChoice camera;
  ShowChoice show;
  std::string gl;  // "egl" or "osmesa"; "" for the first that works
  bool overwrite = false;
};

struct PictureArguments {
  DrawingArguments drawing;
  std::optional<double> at;  // s of simulated time, in a recording; nullopt for its end
};

struct FilmArguments {
  DrawingArguments drawing;
  double seconds = 10;         // of a running robot, simulated
  std::optional<double> from;  // s of simulated time, in a recording
  std::optional<double> to;
  int fps = 30;
  double speed = 1;    // simulated seconds per second of film
  double orbit = 0;    // degrees per second of film that the camera goes round
  bool plain = false;  // without clock and events
};

// Each adds the subcommand with its options, which must outlive the parsing.
CLI::App* AddViewCommand(CLI::App* app, ViewArguments* arguments);
CLI::App* AddPictureCommand(CLI::App* app, PictureArguments* arguments);
CLI::App* AddFilmCommand(CLI::App* app, FilmArguments* arguments);

// The hint of a build without understudy-view.
inline constexpr char kViewerMissing[] =
    "build it: apt-get install libglfw3-dev libegl-dev libturbojpeg0-dev libx264-dev (or run "
    "./tools/up), and not with -DUNDERSTUDY_VIEWER=OFF";

}  // namespace understudy::viewer
