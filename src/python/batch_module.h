// Binds Batch.
#pragma once

#include <nanobind/nanobind.h>

namespace understudy::python {

void BindBatch(nanobind::module_& m);

}  // namespace understudy::python
