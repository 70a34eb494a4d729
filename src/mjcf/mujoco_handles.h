// Owners of MuJoCo's C objects.
#pragma once

#include <memory>

// MuJoCo's own names, so that headers which only pass these on do not bring the library's.
struct mjModel_;
struct mjData_;
using mjModel = mjModel_;
using mjData = mjData_;

namespace understudy::mjcf {

struct ModelDeleter {
  void operator()(mjModel* model) const;
};
struct DataDeleter {
  void operator()(mjData* data) const;
};
using ModelHandle = std::unique_ptr<mjModel, ModelDeleter>;
using DataHandle = std::unique_ptr<mjData, DataDeleter>;

ModelHandle CopyOf(const mjModel& model);

// As mj_makeData. The memory that MuJoCo 2 clears for efc_AR, which the primal solvers do not use,
// is given back: it is most of an mjData and grows with the square of the constraints.
DataHandle MakeData(const mjModel& model);

// For kinematics and inertia alone (mj_kinematics, mj_comPos, mj_crb, mj_factorM): there is no room
// for contacts and constraints, which is most of the memory of a humanoid's mjData. mj_forward and
// mj_step must not be called with it.
DataHandle MakeDataWithoutContacts(const mjModel& model);

// As mj_resetData, but that it leaves efc_AR as it is, which takes most of the time and would take
// its memory again.
void ResetData(const mjModel& model, mjData* data);

}  // namespace understudy::mjcf
