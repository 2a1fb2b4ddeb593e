// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"

#include "arrays.h"

#include <optional>
#include <string>
#include <vector>

namespace trysquare::python {

/// As Python's type checkers see them.
using ProgressCallable = nb::typed<nb::callable, nb::object(nb::str, std::size_t, std::size_t)>;
using LoadCallable = nb::typed<nb::callable, nb::object(std::size_t)>;

/// Scans that are numpy arrays, which it keeps alive. Loading one copies it, without the points that measure nothing.
class ArrayScans : public ScanSequence {
 public:
  explicit ArrayScans(std::vector<PointArray> scans) : scans_(std::move(scans)) {}
  std::size_t size() const override { return scans_.size(); }
  Scan load(std::size_t index) const override;
  std::string name(std::size_t index) const override { return "scans[" + std::to_string(index) + "]"; }

 private:
  std::vector<PointArray> scans_;
};

/// Scans that Python loads when they are asked for: `load(i)` returns an (N, 3) array of doubles.
class PythonScans : public ScanSequence {
 public:
  PythonScans(std::size_t size, LoadCallable load) : size_(size), load_(std::move(load)) {}
  std::size_t size() const override { return size_; }
  Scan load(std::size_t index) const override;
  std::string name(std::size_t index) const override { return "scans[" + std::to_string(index) + "]"; }

 private:
  std::size_t size_;
  LoadCallable load_;
};

/// @param progress  None, or called with (stage, done, total). What it raises is reported and does not stop the work.
Execution execution_of(int threads, std::optional<ProgressCallable> progress);

}  // namespace trysquare::python
