// SPDX-License-Identifier: Apache-2.0
#include "trysquare/dataset/inputs.h"

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

void bind_options(nb::module_& module) {
  nb::class_<InputOptions>(module, "InputOptions")
      .def(nb::init<>())
      .def_rw("scans", &InputOptions::scans)
      .def_rw("poses", &InputOptions::poses)
      .def_rw("reference", &InputOptions::reference)
      .def_rw("poses_format", &InputOptions::poses_format)
      .def_rw("calib", &InputOptions::calibration)
      .def_rw("extrinsic", &InputOptions::extrinsic)
      .def_rw("no_calib", &InputOptions::no_calibration)
      .def_rw("left_handed", &InputOptions::left_handed)
      .def_rw("every", &InputOptions::every)
      .def_rw("first", &InputOptions::first)
      .def_rw("last", &InputOptions::last)
      .def_rw("t_max_diff_s", &InputOptions::max_time_difference_s);
}

void bind_inputs(nb::module_& module) {
  nb::class_<Inputs>(module, "Inputs")
      .def_prop_ro(
          "scans", [](const Inputs& inputs) -> const ScanSequence& { return *inputs.scans; },
          nb::rv_policy::reference_internal)
      .def_prop_ro(
          "poses", [](const Inputs& inputs) { return poses_of(inputs.world_from_scan); }, kOwnValues)
      .def_prop_ro(
          "stamps_ns", [](const Inputs& inputs) { return stamps_of(inputs.world_from_scan); }, kOwnValues)
      .def_prop_ro(
          "all_poses", [](const Inputs& inputs) { return poses_of(inputs.all_poses); }, kOwnValues)
      .def_prop_ro(
          "all_stamps_ns", [](const Inputs& inputs) { return stamps_of(inputs.all_poses); }, kOwnValues)
      .def_prop_ro(
          "reference",
          [](const Inputs& inputs) -> std::optional<Poses> {
            if (!inputs.reference) return std::nullopt;
            return poses_of(*inputs.reference);
          },
          kOwnValues)
      .def_prop_ro(
          "extrinsic",
          [](const Inputs& inputs) -> std::optional<Matrix> {
            if (!inputs.extrinsic) return std::nullopt;
            return matrix_of(inputs.extrinsic->body_from_sensor);
          },
          kOwnValues)
      .def_prop_ro("extrinsic_source",
                   [](const Inputs& inputs) -> std::optional<std::string> {
                     if (!inputs.extrinsic) return std::nullopt;
                     return inputs.extrinsic->description;
                   })
      .def_prop_ro("reference_extrinsic_source",
                   [](const Inputs& inputs) -> std::optional<std::string> {
                     if (!inputs.reference_extrinsic) return std::nullopt;
                     return inputs.reference_extrinsic->description;
                   })
      .def_prop_ro("poses_format", [](const Inputs& inputs) { return std::string(name_of(inputs.format)); })
      .def_prop_ro("warnings", [](const Inputs& inputs) { return codes_and_messages(inputs.warnings); });
}

}  // namespace

void bind_dataset(nb::module_& module) {
  bind_options(module);
  bind_inputs(module);
  module.def(
      "load_inputs",
      [](const InputOptions& options) {
        const nb::gil_scoped_release release;
        return load_inputs(options);
      },
      "options"_a, "Scans and poses as the command pairs them.");
}

}  // namespace trysquare::python
