// Draws one frame of an MJCF model into a PNG without a window (OSMesa). Documentation images only;
// not installed.
//
//   render_model --model go2.xml --model flat.xml --out go2.png --qpos 0 --qpos 0 ...
//
// Several --model files are included into one world in the order given. Without --qpos the model
// stands in its reference configuration.

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <GL/osmesa.h>
#include <mujoco/mujoco.h>
#include <png.h>

namespace {

struct Options {
  std::vector<std::string> models;
  std::string out = "model.png";
  std::vector<double> qpos;
  std::vector<double> lookat{0, 0, 0.3};  // m, world frame
  double azimuth = 140;                   // degrees, as in MuJoCo's free camera
  double elevation = -15;                 // degrees
  double distance = 1.5;                  // m
  int size = 512;                         // pixels, square
  bool collision = false;                 // draw the collision shapes instead of the visual ones
};

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
struct DeleteGl {
  void operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }
};
using ModelPtr = std::unique_ptr<mjModel, DeleteModel>;
using DataPtr = std::unique_ptr<mjData, DeleteData>;

void AddFile(mjVFS* vfs, const std::string& name, const std::string& text) {
  if (mj_makeEmptyFileVFS(vfs, name.c_str(), static_cast<int>(text.size())) != 0) {
    throw std::runtime_error("cannot hold " + name + " in memory");
  }
  const int index = mj_findFileVFS(vfs, name.c_str());
  std::copy(text.begin(), text.end(), static_cast<char*>(vfs->filedata[index]));
}

ModelPtr Load(const std::vector<std::string>& paths) {
  auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  // In the folder of the first file, from where its own includes count.
  const std::filesystem::path folder = std::filesystem::absolute(paths.front()).parent_path();
  const std::string name = (folder / "outer.xml").string();
  std::string outer = "<mujoco>";
  for (const std::string& path : paths) {
    outer += "<include file=\"" + std::filesystem::relative(path, folder).string() + "\"/>";
  }
  outer +=
      "<visual><global offwidth=\"2048\" offheight=\"2048\"/><quality "
      "offsamples=\"4\"/></visual></mujoco>";
  AddFile(vfs.get(), name, outer);
  char error[1024] = "";
  ModelPtr model(mj_loadXML(name.c_str(), vfs.get(), error, sizeof(error)));
  mj_deleteVFS(vfs.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

void WritePng(const std::string& path, int size, const std::vector<unsigned char>& rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(size);
  image.height = static_cast<png_uint_32>(size);
  image.format = PNG_FORMAT_RGB;
  // A negative stride: OpenGL hands over the lowest row first.
  if (png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), -3 * size, nullptr) == 0) {
    throw std::runtime_error("cannot write " + path + ": " + image.message);
  }
}

// Draws at twice the size and averages 2 x 2 pixels: OSMesa has no multisampling.
std::vector<unsigned char> Halve(int size, const std::vector<unsigned char>& big) {
  std::vector<unsigned char> small(static_cast<std::size_t>(size * size * 3));
  const auto at = [&](int row, int column, int c) {
    return static_cast<int>(big[static_cast<std::size_t>((row * 2 * size + column) * 3 + c)]);
  };
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      for (int c = 0; c < 3; ++c) {
        const int sum = at(2 * row, 2 * column, c) + at(2 * row, 2 * column + 1, c) +
                        at(2 * row + 1, 2 * column, c) + at(2 * row + 1, 2 * column + 1, c);
        small[static_cast<std::size_t>((row * size + column) * 3 + c)] =
            static_cast<unsigned char>(sum / 4);
      }
    }
  }
  return small;
}

void Render(const Options& options) {
  const ModelPtr model = Load(options.models);
  const DataPtr data(mj_makeData(model.get()));
  for (std::size_t i = 0; i < options.qpos.size() && static_cast<int>(i) < model->nq; ++i) {
    data->qpos[i] = options.qpos[i];
  }
  mj_forward(model.get(), data.get());

  const int big = 2 * options.size;
  std::vector<unsigned char> frame(static_cast<std::size_t>(big * big * 4));
  const std::unique_ptr<osmesa_context, DeleteGl> gl(
      OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 8, nullptr));
  if (!gl || OSMesaMakeCurrent(gl.get(), frame.data(), GL_UNSIGNED_BYTE, big, big) != GL_TRUE) {
    throw std::runtime_error("no OSMesa context");
  }
  mjvScene scene;
  mjv_defaultScene(&scene);
  mjv_makeScene(model.get(), &scene, 1000);
  mjrContext context;
  mjr_defaultContext(&context);
  mjr_makeContext(model.get(), &context, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context);

  mjvOption show;
  mjv_defaultOption(&show);
  show.geomgroup[2] = options.collision ? 0 : 1;
  show.geomgroup[3] = options.collision ? 1 : 0;
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  std::copy(options.lookat.begin(), options.lookat.end(), camera.lookat);
  camera.azimuth = options.azimuth;
  camera.elevation = options.elevation;
  camera.distance = options.distance;
  mjv_updateScene(model.get(), data.get(), &show, nullptr, &camera, mjCAT_ALL, &scene);

  const mjrRect whole{0, 0, big, big};
  std::vector<unsigned char> rgb(static_cast<std::size_t>(big * big * 3));
  mjr_render(whole, &scene, &context);
  mjr_readPixels(rgb.data(), nullptr, whole, &context);
  WritePng(options.out, options.size, Halve(options.size, rgb));
  mjr_freeContext(&context);
  mjv_freeScene(&scene);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Draws one frame of an MJCF model into a PNG");
  app.add_option("--model", options.models, "MJCF file; may be repeated")->required();
  app.add_option("--out", options.out, "PNG to write");
  app.add_option("--qpos", options.qpos, "generalised positions, as in MuJoCo's qpos");
  app.add_option("--lookat", options.lookat, "point in the middle of the image, m")->expected(3);
  app.add_option("--azimuth", options.azimuth, "camera azimuth, degrees");
  app.add_option("--elevation", options.elevation, "camera elevation, degrees");
  app.add_option("--distance", options.distance, "camera distance, m");
  app.add_option("--size", options.size, "image side, pixels")->check(CLI::Range(16, 1024));
  app.add_flag("--collision", options.collision, "draw collision shapes");
  CLI11_PARSE(app, argc, argv);
  try {
    Render(options);
  } catch (const std::exception& error) {
    std::cerr << "render_model: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
