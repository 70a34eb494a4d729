#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mjxmacro.h>
#include <mujoco/mujoco.h>
#include <sys/mman.h>
#include <unistd.h>

#include "mjcf/compile.h"
#include "mjcf/document.h"
#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {
namespace {

// Where the bodies are and the inertia of what hangs from each, at other angles than 0.
std::vector<double> Kinematics(const mjModel& model, mjData* data) {
  for (int i = 7; i < model.nq; ++i) data->qpos[i] = 0.01 * i;
  mj_kinematics(&model, data);
  mj_comPos(&model, data);
  mj_crb(&model, data);
  std::vector<double> values(data->xpos, data->xpos + 3L * model.nbody);
  values.insert(values.end(), data->crb, data->crb + 10L * model.nbody);
  return values;
}

TEST(DataWithoutContactsTest, HasTheSameKinematicsInLessMemory) {
  const ModelHandle model = CompileMjcf(
      ReadMjcf(std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "models/g1/g1_29dof.xml"));
  const DataHandle whole(mj_makeData(model.get()));
  const DataHandle small = MakeDataWithoutContacts(*model);
  EXPECT_EQ(Kinematics(*model, small.get()), Kinematics(*model, whole.get()));
  EXPECT_LE(small->nbuffer, whole->nbuffer);
#if mjVERSION_HEADER < 300  // later ones make room for contacts when there are any
  EXPECT_LT(small->nbuffer, whole->nbuffer / 10);
#endif
}

// A humanoid that has fallen down from where it begins.
DataHandle Fallen(const mjModel& model) {
  DataHandle data = MakeData(model);
  for (int i = 0; i < 700; ++i) mj_step(&model, data.get());
  EXPECT_GT(data->ncon, 0);
  return data;
}

// The bytes of all arrays and numbers of an mjData but for its places, its sizes, and what only
// solvers of the dual problem use.
std::string Contents(const mjModel& model, const mjData& data) {
  std::string all;
#if mjVERSION_HEADER < 300
  const mjModel* m = &model;
  MJDATA_POINTERS_PREAMBLE(m)
#define X(type, name, rows, columns)                                                           \
  if (std::string_view(#name) != "efc_AR" && std::string_view(#name) != "efc_AR_colind") {     \
    all.append(                                                                                \
        reinterpret_cast<const char*>(data.name),                                              \
        sizeof(type) * static_cast<std::size_t>(m->rows) * static_cast<std::size_t>(columns)); \
  }
  MJDATA_POINTERS
#undef X
#define X(type, name) all.append(reinterpret_cast<const char*>(&data.name), sizeof data.name);
  MJDATA_SCALAR
#undef X
#define X(type, name, rows, columns) \
  all.append(reinterpret_cast<const char*>(data.name), sizeof data.name);
  MJDATA_VECTOR
#undef X
#else
  all.append(reinterpret_cast<const char*>(data.qpos),
             sizeof *data.qpos * static_cast<std::size_t>(model.nq));
  all.append(reinterpret_cast<const char*>(data.qvel),
             sizeof *data.qvel * static_cast<std::size_t>(model.nv));
#endif
  return all;
}

ModelHandle WithAFloorAndATarget() {
  const std::string robot = std::string(UNDERSTUDY_SOURCE_DIR) + "/models/g1/g1_29dof.xml";
  MjcfElement root = ReadMjcf(std::filesystem::path(robot));
  MjcfElement world{.name = "worldbody", .attributes = {}, .children = {}, .place = {}};
  world.children.push_back({.name = "geom",
                            .attributes = {{"type", "plane"}, {"size", "0 0 1"}},
                            .children = {},
                            .place = {}});
  world.children.push_back(
      {.name = "body",
       .attributes = {{"mocap", "true"}, {"pos", "1 2 3"}, {"quat", "0.6 0 0.8 0"}},
       .children = {},
       .place = {}});
  root.children.push_back(std::move(world));
  return CompileMjcf(root);
}

TEST(DataTest, IsResetToWhatMuJoCoResetsItTo) {
  const ModelHandle model = WithAFloorAndATarget();
  const DataHandle ours = Fallen(*model), theirs = Fallen(*model);
  ResetData(*model, ours.get());
  mj_resetData(model.get(), theirs.get());
  EXPECT_EQ(Contents(*model, *ours), Contents(*model, *theirs));
  for (int i = 0; i < 700; ++i) {
    mj_step(model.get(), ours.get());
    mj_step(model.get(), theirs.get());
  }
  EXPECT_EQ(Contents(*model, *ours), Contents(*model, *theirs));
}

#if mjVERSION_HEADER < 300
// Pages of an array that are in memory.
std::size_t PagesInMemory(const void* begin, std::size_t bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t from = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const std::size_t pages = (reinterpret_cast<std::uintptr_t>(begin) + bytes - from) / page;
  std::vector<unsigned char> held(pages);
  EXPECT_EQ(mincore(reinterpret_cast<void*>(from), pages * page, held.data()), 0);
  return static_cast<std::size_t>(
      std::count_if(held.begin(), held.end(), [](unsigned char one) { return (one & 1) != 0; }));
}

TEST(DataTest, TakesNoMemoryForWhatThePrimalSolversDoNotUse) {
  const ModelHandle model = WithAFloorAndATarget();
  const DataHandle data = Fallen(*model);
  ResetData(*model, data.get());
  const auto rows = static_cast<std::size_t>(model->njmax);
  const std::size_t bytes = rows * rows * sizeof *data->efc_AR;
  ASSERT_GT(bytes, 20U * 4096);
  EXPECT_EQ(PagesInMemory(data->efc_AR, bytes), 0U);
}
#endif

}  // namespace
}  // namespace understudy::mjcf
