// Binds the definitions and networks of policies.
#pragma once

#include <nanobind/nanobind.h>

namespace understudy::python {

void BindPolicy(nanobind::module_& m);

}  // namespace understudy::python
