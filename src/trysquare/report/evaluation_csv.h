// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trysquare {

/// The windows of an evaluation, one row each: first, last, mom_m2, omme_nats, mpv_m2, mme_nats, multi_scan_share,
/// scans_per_neighborhood, rpe_m. A value that does not exist is an empty cell.
/// @param evaluation_json   "trysquare.evaluation/1", as to_json() writes it.
/// @throws InvalidArgument  if it is anything else.
std::string windows_csv(std::string_view evaluation_json);

/// The poses, one row each: index, x_m, y_m, z_m, the sensor's position in the map frame.
/// @throws InvalidArgument  as above.
std::string poses_csv(std::string_view evaluation_json);

}  // namespace trysquare
