// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/points.h"
#include "trysquare/metrics/orthogonal_subset.h"
#include "trysquare/report/evaluation_figures.h"

#include <string>
#include <string_view>

namespace trysquare {

/// What `trysquare orthogonal` has to say of windows, as CSV: a row a window with its scans, points and, for each of
/// three directions, points, normal and how far it moved; empty cells where there is no direction.
/// @param orthogonal_json  Schema "trysquare.orthogonal/1".
/// @throws InvalidArgument  if it is not.
std::string orthogonal_windows_csv(std::string_view orthogonal_json);

/// The same as a figure, `windows.svg`: the points of each direction and the largest move, over the scans.
/// @throws InvalidArgument  as above, and without windows.
Figure orthogonal_windows_figure(std::string_view orthogonal_json);

/// The points of the directions in red, green and blue over those of the scans in grey, as in the paper:
/// `orthogonal.svg`. Seen obliquely along all three directions, the first one upwards, so that each shows its face;
/// without perspective. The margins beyond the middle 98 % of the points are left out, and grey points are thinned to
/// some thousands.
/// @param points_in_map  Of the scans that were looked at; N points [m].
/// @throws InvalidArgument  without points.
Figure orthogonal_picture(PointsView points_in_map, const OrthogonalSubset& subset);

}  // namespace trysquare
