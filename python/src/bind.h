// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace trysquare::python {

namespace nb = nanobind;

// One for each folder of the library.
void bind_adjustment(nb::module_& module);
void bind_clusters(nb::module_& module);
void bind_dataset(nb::module_& module);
void bind_io(nb::module_& module);
void bind_metrics(nb::module_& module);
void bind_pipeline(nb::module_& module);
void bind_scans(nb::module_& module);
void bind_settings(nb::module_& module);
void bind_trajectory(nb::module_& module);

}  // namespace trysquare::python
