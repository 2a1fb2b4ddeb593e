// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/for_each_neighborhood.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/scalar_moments.h"
#include "trysquare/neighborhood/internal/super_groups.h"
#include "trysquare/neighborhood/internal/visit_neighborhoods.h"
#include "trysquare/parallel/for_each_block.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace trysquare {
namespace {

/// What one thread needs.
struct Workspace {
  explicit Workspace(const PointIndex::Tree& tree) : scratch(tree.has_scans() ? tree.num_scans : 0), scalar(tree) {}

  BallScratch scratch;
  ScalarMoments scalar;
  std::vector<Moments> moments;
};

/// Lends workspaces to blocks, so that there are no more of them than threads.
class WorkspacePool {
 public:
  explicit WorkspacePool(const PointIndex::Tree& tree) : tree_(tree) {}

  std::unique_ptr<Workspace> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<Workspace>(tree_);
    std::unique_ptr<Workspace> workspace = std::move(free_.back());
    free_.pop_back();
    return workspace;
  }
  void give_back(std::unique_ptr<Workspace> workspace) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(workspace));
  }

 private:
  const PointIndex::Tree& tree_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> free_;
};

class Visitor {
 public:
  Visitor(const VectorKernels* kernels, const PointIndex::Tree& tree, const PackedPoints& queries, double radius_m)
      : kernels_(tree.packed.num_points > 0 && fits_single_precision(tree.cube.edge_m, radius_m) ? kernels : nullptr),
        tree_(tree),
        queries_(queries),
        radius_m_(radius_m) {}

  /// The moments of the queries of one super-group, in packed order.
  void fill_moments(const SuperGroup& super_group, Workspace& workspace) const {
    workspace.moments.resize(super_group.num_queries);
    if (kernels_ != nullptr) {
      start_super_group(tree_, queries_, radius_m_, super_group, workspace.scratch);
      kernels_->add_balls(tree_, queries_, radius_m_, super_group, workspace.scratch);
    }
    for (std::size_t i = 0; i < super_group.num_queries; ++i) {
      workspace.moments[i] = moments_of(i, queries_.point(super_group.first_query + i), workspace);
    }
  }

 private:
  Moments moments_of(std::size_t i, const Eigen::Vector3d& query, Workspace& workspace) const {
    if (kernels_ == nullptr) return workspace.scalar.around(query, radius_m_);
    const MomentRow sums = sums_of_query(workspace.scratch, i);
    Moments moments = moments_from(sums, query - workspace.scratch.center);
    if (cancels(sums, moments)) return workspace.scalar.around(query, radius_m_);
    if (tree_.has_scans()) moments.num_scans = workspace.scratch.scans.count(i);
    return moments;
  }

  const VectorKernels* kernels_;
  const PointIndex::Tree& tree_;
  const PackedPoints& queries_;
  double radius_m_;
};

/// Tells of queries, not of super-groups.
ProgressCallback progress_in_queries(const ProgressCallback& progress, std::size_t num_queries) {
  if (!progress) return {};
  return [&progress, num_queries](std::string_view stage, std::size_t done, std::size_t total) {
    progress(stage, total == 0 ? num_queries : num_queries * done / total, num_queries);
  };
}

}  // namespace

void NeighborhoodSettings::validate() const {
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    throw InvalidArgument(fmt::format("radius_m = {} is out of range: it must be positive and finite", radius_m));
  }
  if (min_neighbors < 3) {
    throw InvalidArgument(fmt::format("min_neighbors = {} is out of range: it must be at least 3", min_neighbors));
  }
}

void visit_neighborhoods(const VectorKernels* kernels, const PointIndex& map, PointsView queries_in_map,
                         const NeighborhoodSettings& settings, const Execution& execution,
                         const std::function<void(const NeighborhoodBlock&)>& visit) {
  constexpr std::size_t kSuperGroupsPerBlock = 4;
  settings.validate();
  const PointIndex::Tree& tree = map.tree();
  std::optional<PackedPoints> other_queries;
  if (queries_in_map.data() != tree.source.data() || queries_in_map.size() != tree.source.size()) {
    validate_points("queries_in_map", queries_in_map);
    other_queries.emplace(queries_in_map, hilbert_order(queries_in_map, tree.cube, execution), tree.packed.origin,
                          execution);
  }
  const PackedPoints& queries = other_queries ? *other_queries : tree.packed;
  const std::vector<SuperGroup> groups = super_groups(queries, settings.radius_m);
  const Visitor visitor(kernels, tree, queries, settings.radius_m);
  WorkspacePool pool(tree);
  const Execution in_queries{.num_threads = execution.num_threads,
                             .progress = progress_in_queries(execution.progress, queries_in_map.size())};
  for_each_block(groups.size(), kSuperGroupsPerBlock, in_queries, "neighborhoods", [&](const Block& block) {
    std::unique_ptr<Workspace> workspace = pool.take();
    for (std::size_t i = block.begin; i < block.end; ++i) {
      visitor.fill_moments(groups[i], *workspace);
      visit({std::span(queries.original_index).subspan(groups[i].first_query, groups[i].num_queries),
             workspace->moments});
    }
    pool.give_back(std::move(workspace));
  });
}

void for_each_neighborhood(const PointIndex& map, PointsView queries_in_map, const NeighborhoodSettings& settings,
                           const Execution& execution, const std::function<void(const NeighborhoodBlock&)>& visit) {
  visit_neighborhoods(&vector_kernels().front(), map, queries_in_map, settings, execution, visit);
}

}  // namespace trysquare
