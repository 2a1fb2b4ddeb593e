// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/dataset/inputs.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/file.h"
#include "trysquare/io/read_points.h"
#include "trysquare/io/trajectory_file.h"

#include "arrays.h"
#include "bind.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace trysquare::python {
namespace {

using namespace nb::literals;

std::optional<TrajectoryFormat> format_named(const std::optional<std::string>& name) {
  return name ? format_option(*name) : std::nullopt;
}

void bind_trajectory_file(nb::module_& module) {
  nb::class_<TrajectoryFile>(module, "TrajectoryFile")
      .def_prop_ro(
          "poses", [](const TrajectoryFile& file) { return poses_of(file.trajectory); }, kOwnValues)
      .def_prop_ro(
          "stamps_ns", [](const TrajectoryFile& file) { return stamps_of(file.trajectory); }, kOwnValues)
      .def_prop_ro("format", [](const TrajectoryFile& file) { return std::string(name_of(file.format)); })
      .def_prop_ro("warnings", [](const TrajectoryFile& file) { return codes_and_messages(file.warnings); });
  module.def(
      "read_trajectory",
      [](const std::string& spec, const std::optional<std::string>& format) {
        const nb::gil_scoped_release release;
        return read_trajectory(spec, format_named(format));
      },
      "spec"_a, "format"_a.none());
  module.def(
      "write_trajectory",
      [](const std::string& path, const PoseArray& poses, const std::optional<StampArray>& stamps_ns,
         const std::string& format) {
        const Trajectory trajectory = trajectory_of(poses, stamps_ns);
        const nb::gil_scoped_release release;
        write_trajectory(path, trajectory, format_named(format).value_or(TrajectoryFormat::kKitti));
      },
      "path"_a, "poses"_a, "stamps_ns"_a.none(), "format"_a);
}

}  // namespace

void bind_io(nb::module_& module) {
  bind_trajectory_file(module);
  module.def(
      "write_file", [](const std::string& path, const std::string& text) { write_file(path, text); }, "path"_a,
      "text"_a, "Writes a file whole or not at all.");
  module.def(
      "read_points",
      [](const std::string& path) {
        std::vector<Eigen::Vector3d> points;
        {
          const nb::gil_scoped_release release;
          points = read_points(path, Columns::kNone).points;
        }
        return array_of(std::move(points));
      },
      "path"_a, "All points of a file, invalid returns included.");
  module.def(
      "read_calibration", [](const std::string& path) { return matrix_of(read_kitti_calibration(path)); }, "path"_a);
  module.def(
      "read_extrinsic", [](const std::string& spec) { return matrix_of(read_extrinsic(spec)); }, "file_or_numbers"_a);
}

}  // namespace trysquare::python
