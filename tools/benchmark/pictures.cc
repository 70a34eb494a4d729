#include "pictures.h"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <mujoco/mujoco.h>

#include "base/printed.h"
#include "base/temporary_folder.h"
#include "mjcf/mujoco_handles.h"
#include "process.h"
#include "viewer/headless_gl.h"
#include "viewer/live_robot.h"

namespace understudy::bench {
namespace {

using std::chrono::steady_clock;

// The focal lengths, in pixels, are those of the robot's own camera. How long the rest of a lens
// takes does not depend on its figures.
struct Size {
  const char* name;
  int width, height;
  const char* settings;
  double wanted;  // pictures per s
};
constexpr Size kSizes[] = {
    {.name = "1280 x 720", .width = 1280, .height = 720, .settings = "", .wanted = 14},
    {.name = "1920 x 1080",
     .width = 1920,
     .height = 1080,
     .settings = "robot.cameras=[{name: front, service: videohub, pos: [0.32715, -0.00003, "
                 "0.04297], width: 1920, height: 1080, focal: [1310.8, 1320.3], centre: [1018.7, "
                 "637.4], distortion: [-0.416, 0.159, 0, 0]}]",
     .wanted = 5}};

double Since(steady_clock::time_point since) {
  return std::chrono::duration<double>(steady_clock::now() - since).count();
}

// In a stream of JPEGs one behind the other.
double CountOfJpegs(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  constexpr std::string_view kBegin = "\xff\xd8\xff";
  double count = 0;
  for (std::size_t at = bytes.find(kBegin); at != std::string::npos;
       at = bytes.find(kBegin, at + 1)) {
    ++count;
  }
  return count;
}

// ms that MuJoCo takes for a picture of that size of the model's first state, and to read it back.
double AloneMs(const mjModel& compiled, const Size& size, double seconds) {
  const mjcf::ModelHandle model = mjcf::CopyOf(compiled);
  model->vis.global.offwidth = size.width;
  model->vis.global.offheight = size.height;
  const mjcf::DataHandle data = mjcf::MakeData(*model);
  mj_forward(model.get(), data.get());
  mjvScene scene;
  mjv_defaultScene(&scene);
  mjv_makeScene(model.get(), &scene, 2000);
  mjrContext context;
  mjr_defaultContext(&context);
  mjr_makeContext(model.get(), &context, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context);
  mjvOption options;
  mjv_defaultOption(&options);
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  camera.type = mjCAMERA_FIXED;
  camera.fixedcamid = mj_name2id(model.get(), mjOBJ_CAMERA, "front");
  std::vector<std::uint8_t> rgb(3UL * static_cast<std::size_t>(size.width * size.height));
  const auto draw = [&] {
    mjv_updateScene(model.get(), data.get(), &options, nullptr, &camera, mjCAT_ALL, &scene);
    const mjrRect all{0, 0, size.width, size.height};
    mjr_render(all, &scene, &context);
    mjr_readPixels(rgb.data(), nullptr, all, &context);
  };
  draw();
  const steady_clock::time_point begun = steady_clock::now();
  int count = 0;
  while (Since(begun) < seconds) {
    draw();
    ++count;
  }
  const double each = 1e3 * Since(begun) / count;
  mjr_freeContext(&context);
  mjv_freeScene(&scene);
  return each;
}

std::vector<Figure> Measure(const std::string& understudy, const Size& size, double seconds) {
  std::vector<std::string> options = {"--start", "standing"};
  if (*size.settings != '\0') options.insert(options.end(), {"--set", size.settings});
  const Daemon daemon(understudy, "go2", options);
  daemon.AwaitReady();
  const TemporaryFolder folder("bench");
  const std::string file = folder.path() / "pictures";
  const auto watch = [&](double s) {
    const int code = RunToEnd({"/bin/sh", "-c", "exec \"$@\" > \"$0\"", file, understudy, "camera",
                               "front", "--socket", daemon.socket(), "--out", "-", "--hz", "60",
                               "--seconds", Printed("%g", s)});
    if (code != 0) throw std::runtime_error("a camera failed: exit code " + std::to_string(code));
  };
  watch(1);  // what draws has started then
  const std::int64_t steps = daemon.Steps();
  const steady_clock::time_point begun = steady_clock::now();
  watch(seconds);
  const double kept = 1e-3 * static_cast<double>(daemon.Steps() - steps) / Since(begun);
  const std::string which = std::string("pictures, ") + size.name;
  return {{.robot = "go2",
           .name = which + ", of a running robot",
           .unit = "/s",
           .value = CountOfJpegs(file) / seconds,
           .bound = size.wanted,
           .wanted = Wanted::kAtLeast},
          {.robot = "go2",
           .name = which + ", simulated s per s meanwhile",
           .unit = "",
           .value = kept,
           .bound = 0.99,
           .wanted = Wanted::kAtLeast},
          {.robot = "go2",
           .name = which + ", one by MuJoCo alone",
           .unit = "ms",
           .value = AloneMs(*viewer::FetchModel(daemon.socket()), size, seconds)}};
}

}  // namespace

std::vector<Figure> MeasurePictures(const std::string& understudy, double seconds) {
  const auto gl = viewer::MakeHeadlessGl("");
  std::vector<Figure> figures;
  for (const Size& size : kSizes) {
    for (Figure& figure : Measure(understudy, size, seconds)) {
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace understudy::bench
