#include "physics/scene_reader.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <mujoco/mujoco.h>

#include "mjcf/compile.h"

namespace understudy::physics {
namespace {

static_assert(std::endian::native == std::endian::little, "what is sent is little endian");

template <std::size_t kCount, class From>
auto Array(const From* from) {
  std::array<From, kCount> to{};
  std::copy_n(from, kCount, to.begin());
  return to;
}

std::string NameOf(const mjModel& model, mjtObj type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name == nullptr ? std::string{} : std::string{name};
}

std::string TypeName(int type) {
  switch (type) {
    case mjGEOM_PLANE:
      return "plane";
    case mjGEOM_HFIELD:
      return "hfield";
    case mjGEOM_SPHERE:
      return "sphere";
    case mjGEOM_CAPSULE:
      return "capsule";
    case mjGEOM_ELLIPSOID:
      return "ellipsoid";
    case mjGEOM_CYLINDER:
      return "cylinder";
    case mjGEOM_BOX:
      return "box";
    case mjGEOM_MESH:
      return "mesh";
    default:
      return "none";
  }
}

// The material's colour applies unless the geom has one, as in MuJoCo's viewer.
std::array<float, 4> Colour(const mjModel& model, int geom) {
  constexpr std::array<float, 4> kDefault{0.5F, 0.5F, 0.5F, 1};
  const auto own = Array<4>(model.geom_rgba + 4 * geom);
  const int material = model.geom_matid[geom];
  if (material < 0 || own != kDefault) return own;
  return Array<4>(model.mat_rgba + 4 * material);
}

SceneGeom Geom(const mjModel& model, int i) {
  SceneGeom geom{.name = NameOf(model, mjOBJ_GEOM, i),
                 .body = model.geom_bodyid[i],
                 .type = TypeName(model.geom_type[i]),
                 .size = Array<3>(model.geom_size + 3 * i),
                 .pos = Array<3>(model.geom_pos + 3 * i),
                 .quat = Array<4>(model.geom_quat + 4 * i),
                 .rgba = Colour(model, i),
                 .group = model.geom_group[i],
                 .collides = model.geom_contype[i] != 0 || model.geom_conaffinity[i] != 0};
  // A shape that was fitted to a mesh still refers to it.
  if (model.geom_type[i] == mjGEOM_MESH) geom.mesh = model.geom_dataid[i];
  if (model.geom_type[i] == mjGEOM_HFIELD) geom.hfield = model.geom_dataid[i];
  return geom;
}

template <class T>
void Append(const T* from, std::size_t count, std::string* to) {
  const std::size_t bytes = count * sizeof(T);
  const std::size_t before = to->size();
  to->resize(before + bytes);
  if (bytes > 0) std::memcpy(to->data() + before, from, bytes);
}

void AppendCounts(int first, int second, std::string* to) {
  const std::uint32_t counts[] = {static_cast<std::uint32_t>(first),
                                  static_cast<std::uint32_t>(second)};
  Append(counts, 2, to);
}

}  // namespace

const mjModel& SceneReader::model() {
  if (!model_) model_ = get_();
  return *model_;
}

Scene SceneReader::DescribeScene(const mjModel& model) {
  Scene scene{.mujoco = mjcf::MujocoVersion(),
              .timestep = model.opt.timestep,
              .gravity = Array<3>(model.opt.gravity)};
  for (int i = 0; i < model.nbody; ++i) {
    scene.bodies.push_back({.name = NameOf(model, mjOBJ_BODY, i),
                            .parent = model.body_parentid[i],
                            .mass = model.body_mass[i]});
  }
  for (int i = 0; i < model.ngeom; ++i) scene.geoms.push_back(Geom(model, i));
  for (int i = 0; i < model.nmesh; ++i) {
    scene.meshes.push_back({.name = NameOf(model, mjOBJ_MESH, i),
                            .vertices = model.mesh_vertnum[i],
                            .faces = model.mesh_facenum[i]});
  }
  for (int i = 0; i < model.nhfield; ++i) {
    scene.hfields.push_back({.name = NameOf(model, mjOBJ_HFIELD, i),
                             .rows = model.hfield_nrow[i],
                             .columns = model.hfield_ncol[i],
                             .size = Array<4>(model.hfield_size + 4 * i)});
  }
  for (int i = 0; i < model.ncam; ++i) {
    scene.cameras.push_back({.name = NameOf(model, mjOBJ_CAMERA, i),
                             .body = model.cam_bodyid[i],
                             .pos = Array<3>(model.cam_pos + 3 * i),
                             .quat = Array<4>(model.cam_quat + 4 * i),
                             .fovy = model.cam_fovy[i]});
  }
  for (int i = 0; i < model.njnt; ++i) {
    scene.joints.push_back({.name = NameOf(model, mjOBJ_JOINT, i),
                            .range = Array<2>(model.jnt_range + 2 * i),
                            .limited = model.jnt_limited[i] != 0,
                            .position = model.jnt_qposadr[i]});
  }
  return scene;
}

// mjtSize, since MuJoCo 3, is wider.
int SceneReader::meshes() { return static_cast<int>(model().nmesh); }
int SceneReader::hfields() { return static_cast<int>(model().nhfield); }

std::string SceneReader::Mesh(int mesh) {
  const mjModel& from = model();
  const auto vertices = static_cast<std::size_t>(from.mesh_vertnum[mesh]);
  const auto faces = static_cast<std::size_t>(from.mesh_facenum[mesh]);
  std::string bytes;
  bytes.reserve(8 + 12 * (vertices + faces));
  AppendCounts(from.mesh_vertnum[mesh], from.mesh_facenum[mesh], &bytes);
  Append(from.mesh_vert + 3 * from.mesh_vertadr[mesh], 3 * vertices, &bytes);
  Append(from.mesh_face + 3 * from.mesh_faceadr[mesh], 3 * faces, &bytes);
  return bytes;
}

std::string SceneReader::HeightField(int hfield) {
  const mjModel& from = model();
  const int rows = from.hfield_nrow[hfield];
  const int columns = from.hfield_ncol[hfield];
  std::string bytes;
  AppendCounts(rows, columns, &bytes);
  Append(from.hfield_data + from.hfield_adr[hfield],
         static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), &bytes);
  return bytes;
}

std::size_t SceneReader::positions() { return static_cast<std::size_t>(model().nq); }

std::span<const BodyPose> SceneReader::Poses(std::span<const double> qpos) {
  const mjModel& of = model();
  if (!data_) data_ = mjcf::MakeDataWithoutContacts(of);
  std::copy_n(qpos.begin(), std::min(qpos.size(), positions()), data_->qpos);
  mj_kinematics(&of, data_.get());
  poses_.resize(static_cast<std::size_t>(of.nbody));
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    std::copy_n(data_->xpos + 3 * i, 3, poses_[i].begin());
    std::copy_n(data_->xquat + 4 * i, 4, poses_[i].begin() + 3);
  }
  return poses_;
}

std::string SceneReader::Model() { return mjcf::ModelBytes(model()); }

}  // namespace understudy::physics
