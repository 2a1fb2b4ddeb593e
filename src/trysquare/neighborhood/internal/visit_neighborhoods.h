// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/for_each_neighborhood.h"
#include "trysquare/neighborhood/internal/vector_kernels.h"

namespace trysquare {

/// for_each_neighborhood() by kernels of choice; nullptr: the plain way, without any.
void visit_neighborhoods(const VectorKernels* kernels, const PointIndex& map, PointsView queries_in_map,
                         const NeighborhoodSettings& settings, const Execution& execution,
                         const std::function<void(const NeighborhoodBlock&)>& visit);

}  // namespace trysquare
