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

}  // namespace understudy::mjcf
