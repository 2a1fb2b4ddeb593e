// SPDX-License-Identifier: Apache-2.0
#include "scans.h"

#include "trysquare/core/measured_points.h"

#include "bind.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <string_view>
#include <utility>

namespace trysquare::python {

Scan ArrayScans::load(std::size_t index) const {
  const PointsView points = view_of(scans_.at(index));
  return scan_of_measured({points.begin(), points.end()});
}

Scan PythonScans::load(std::size_t index) const {
  const nb::gil_scoped_acquire gil;
  const auto array = nb::cast<PointArray>(load_(index));
  const PointsView points = view_of(array);
  return scan_of_measured({points.begin(), points.end()});
}

Execution execution_of(int threads, std::optional<ProgressCallable> progress) {
  Execution execution{.num_threads = threads, .progress = {}};
  if (!progress) return execution;
  // The caller's frame holds the callable for as long as the work lasts.
  const nb::handle callback = *progress;
  execution.progress = [callback](std::string_view stage, std::size_t done, std::size_t total) {
    const nb::gil_scoped_acquire gil;
    try {
      callback(nb::str(stage.data(), stage.size()), done, total);
    } catch (nb::python_error& error) {
      if (error.matches(PyExc_KeyboardInterrupt)) {
        PyErr_SetInterrupt();  // not lost: Python raises it when the work is done
      } else {
        error.discard_as_unraisable("the progress callback of trysquare");
      }
    }
  };
  return execution;
}

void bind_scans(nb::module_& module) {
  nb::class_<ScanSequence>(module, "Scans", "N scans that are loaded one at a time.")
      .def("__len__", &ScanSequence::size)
      .def(
          "load",
          [](const ScanSequence& scans, std::size_t index) {
            if (index >= scans.size()) throw nb::index_error("scan index out of range");
            nb::gil_scoped_release release;
            std::vector<Eigen::Vector3d> points = scans.load(index).points_in_scan;
            nb::gil_scoped_acquire acquire;
            return array_of(std::move(points));
          },
          nb::arg("index"), "(N, 3) points [m] of one scan in its own frame, without invalid returns.")
      .def("name", &ScanSequence::name, nb::arg("index"), "What messages call the scan: the path of its file.");

  module.def(
      "array_scans",
      [](std::vector<PointArray> scans) -> std::unique_ptr<ScanSequence> {
        return std::make_unique<ArrayScans>(std::move(scans));
      },
      nb::arg("scans"), "Scans of (N, 3) arrays of doubles, which are kept and not copied.");
  module.def(
      "python_scans",
      [](std::size_t size, LoadCallable load) -> std::unique_ptr<ScanSequence> {
        return std::make_unique<PythonScans>(size, std::move(load));
      },
      nb::arg("size"), nb::arg("load"), "Scans that load(index) returns as (N, 3) arrays of doubles.");
}

}  // namespace trysquare::python
