// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/pipeline/diagnosis.h"

#include <optional>
#include <string>
#include <string_view>

namespace trysquare {

/// What only the caller of diagnose() knows.
struct DiagnosisFacts {
  std::string version;                     ///< Of trysquare.
  std::string scans;                       ///< SCANS as typed.
  std::string poses;                       ///< POSES as typed.
  std::string poses_format;                ///< As recognised.
  bool left_handed = false;                ///< Whether y of points and poses was negated.
  std::optional<std::string> extrinsic{};  ///< Where body_from_sensor came from, e.g. "calib.txt:Tr".
};

/// A diagnosis as JSON text, schema "trysquare.diagnosis/1" (docs/schema/diagnosis.schema.json). Same input, same
/// bytes.
std::string to_json(const Diagnosis& diagnosis, const DiagnosisSettings& settings, const DiagnosisFacts& facts);

/// The findings of a diagnosis as a table, one a line: id, severity, found, limit, unit, message, remedy.
/// @throws InvalidArgument  if the text is no diagnosis.
std::string findings_csv(std::string_view diagnosis_json);

}  // namespace trysquare
