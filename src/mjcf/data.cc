#include <cstddef>
#include <cstdint>
#include <cstring>

#include <mujoco/mjxmacro.h>
#include <mujoco/mujoco.h>
#include <sys/mman.h>
#include <unistd.h>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {
namespace {

#if mjVERSION_HEADER < 300
// efc_AR and efc_AR_colind grow with the square of the rows. Solvers of the primal problem never
// read them, and those of the dual one write them first in each step.
bool GrowsWithTheSquareOfRows(const mjData& data, const void* array) {
  return array == data.efc_AR || array == data.efc_AR_colind;
}

// Makes whole pages of zeros take no memory until somebody writes there.
void GiveBack(void* begin, std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t over = reinterpret_cast<std::uintptr_t>(begin) % page;
  const std::size_t before = over == 0 ? 0 : page - over;
  if (bytes < before + page) return;
  madvise(static_cast<char*>(begin) + before, (bytes - before) / page * page, MADV_DONTNEED);
}
#endif

}  // namespace

void DataDeleter::operator()(mjData* data) const { mj_deleteData(data); }

DataHandle MakeData(const mjModel& model) {
  DataHandle data(mj_makeData(&model));
#if mjVERSION_HEADER < 300
  const auto rows = static_cast<std::size_t>(model.njmax);
  GiveBack(data->efc_AR, rows * rows * sizeof *data->efc_AR);
  GiveBack(data->efc_AR_colind, rows * rows * sizeof *data->efc_AR_colind);
#endif
  return data;
}

DataHandle MakeDataWithoutContacts(const mjModel& model) {
  mjModel sizes = model;  // owns nothing
  sizes.njmax = 0;
  sizes.nconmax = 0;
  return DataHandle(mj_makeData(&sizes));
}

void ResetData(const mjModel& model, mjData* data) {
#if mjVERSION_HEADER < 300
  const int nstack = data->nstack, nbuffer = data->nbuffer;
#define X(type, name) data->name = 0;
  MJDATA_SCALAR
#undef X
  data->nstack = nstack;
  data->nbuffer = nbuffer;
#define X(type, name, rows, columns) std::memset(data->name, 0, sizeof data->name);
  MJDATA_VECTOR
#undef X
  const mjModel* m = &model;
  MJDATA_POINTERS_PREAMBLE(m)
#define X(type, name, rows, columns)                                                           \
  if (!GrowsWithTheSquareOfRows(*data, data->name)) {                                          \
    std::memset(                                                                               \
        data->name, 0,                                                                         \
        sizeof(type) * static_cast<std::size_t>(m->rows) * static_cast<std::size_t>(columns)); \
  }
  MJDATA_POINTERS
#undef X
  mju_copy(data->qpos, model.qpos0, model.nq);
  for (int body = 0; body < model.nbody; ++body) {
    const int mocap = model.body_mocapid[body];
    if (mocap < 0) continue;
    mju_copy3(data->mocap_pos + 3 * mocap, model.body_pos + 3 * body);
    mju_copy4(data->mocap_quat + 4 * mocap, model.body_quat + 4 * body);
    mju_normalize4(data->mocap_quat + 4 * mocap);
  }
#else
  mj_resetData(&model, data);
#endif
}

}  // namespace understudy::mjcf
