// Describes a compiled world for viewers: bodies, shapes, colours, meshes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "physics/world_reading.h"

namespace understudy::physics {

struct SceneBody {
  std::string name;
  int parent = 0;
  double mass = 0;  // kg
};

struct SceneGeom {
  std::string name;
  int body = 0;
  std::string type;                        // MuJoCo's name: plane, hfield, sphere, capsule, ...
  std::array<double, 3> size{};            // m, as in MuJoCo for the type
  std::array<double, 3> pos{};             // m, in the body's frame
  std::array<double, 4> quat{1, 0, 0, 0};  // in the body's frame
  std::array<float, 4> rgba{};             // combined with the material's
  int group = 0;
  bool collides = false;
  int mesh = -1;
  int hfield = -1;
};

struct SceneMesh {
  std::string name;
  int vertices = 0;
  int faces = 0;
};

struct SceneHeightField {
  std::string name;
  int rows = 0;
  int columns = 0;
  std::array<double, 4> size{};  // m: half of x, half of y, height of the data's 1, base below 0
};

struct SceneCamera {
  std::string name;
  int body = 0;
  std::array<double, 3> pos{};
  std::array<double, 4> quat{1, 0, 0, 0};
  double fovy = 45;  // degrees
};

struct SceneJoint {
  std::string name;
  std::array<double, 2> range{};  // rad or m
  bool limited = false;
  int position = 0;  // index in qpos
};

// A scene. Indices are MuJoCo's ids: body 3 is bodies[3].
struct Scene {
  std::string mujoco;  // version of the library
  double timestep = 0;
  std::array<double, 3> gravity{};
  std::vector<SceneBody> bodies{};
  std::vector<SceneGeom> geoms{};
  std::vector<SceneMesh> meshes{};
  std::vector<SceneHeightField> hfields{};
  std::vector<SceneCamera> cameras{};
  std::vector<SceneJoint> joints{};
};

// Reads a model for viewers, which it gets at the first call. For one thread. All functions throw
// what getting the model throws.
class SceneReader {
 public:
  using GetModel = std::function<std::shared_ptr<const mjModel>()>;

  explicit SceneReader(GetModel get) : get_(std::move(get)) {}

  Scene Describe() { return DescribeScene(model()); }
  int meshes();
  int hfields();
  // Little endian: u32 vertices, u32 faces, then x, y, z of each vertex [m] as float32, then three
  // u32 indices of each face. `mesh` < meshes().
  std::string Mesh(int mesh);
  // Little endian: u32 rows, u32 columns, then the heights row by row as float32, from 0 to 1 of
  // size[2]. `hfield` < hfields().
  std::string HeightField(int hfield);
  // As mj_saveModel writes it: for the same version of MuJoCo only.
  std::string Model();
  std::size_t positions();  // of qpos
  // Returns where the bodies are at these joint positions, by MuJoCo's id; valid until the next
  // call. `qpos` has positions() numbers, of any values.
  std::span<const BodyPose> Poses(std::span<const double> qpos);

 private:
  const mjModel& model();
  static Scene DescribeScene(const mjModel& model);

  GetModel get_;
  std::shared_ptr<const mjModel> model_;  // null before the first call
  mjcf::DataHandle data_;                 // for Poses; null before
  std::vector<BodyPose> poses_;
};

}  // namespace understudy::physics
