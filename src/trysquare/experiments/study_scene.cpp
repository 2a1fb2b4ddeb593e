// SPDX-License-Identifier: Apache-2.0
#include "trysquare/experiments/study_scene.h"

#include "trysquare/core/error.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/synthetic/memory_scans.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kNumDirections = 3;

std::string out_of_range(const char* name, std::size_t value, const char* range) {
  std::string text(name);
  text.append(" = ").append(std::to_string(value)).append(" is out of range: it must be ").append(range);
  return text;
}

void require_several_scans(std::size_t num_scans) {
  if (num_scans < 2) throw InvalidArgument(out_of_range("num_scans", num_scans, ">= 2"));
}

void require_points(const StudyScene& scene, std::span<const ScanPoint> points) {
  for (const ScanPoint& point : points) {
    if (point.scan < scene.points_in_scan.size() && point.index < scene.points_in_scan[point.scan].size()) continue;
    throw InvalidArgument("the scene has no point " + std::to_string(point.index) + " of scan " +
                          std::to_string(point.scan));
  }
}

std::size_t num_points_of(const StudyScene& scene) {
  std::size_t count = 0;
  for (const auto& points : scene.points_in_scan) count += points.size();
  return count;
}

/// Every n-th point, in scan order, n as large as `at_least` points allow.
std::vector<ScanPoint> evenly_spread(const StudyScene& scene, std::size_t at_least) {
  const std::size_t every = std::max<std::size_t>(num_points_of(scene) / at_least, 1);
  std::vector<ScanPoint> points;
  std::size_t number = 0;
  for (std::size_t scan = 0; scan < scene.points_in_scan.size(); ++scan) {
    for (std::size_t i = 0; i < scene.points_in_scan[scan].size(); ++i, ++number) {
      if (number % every == 0) points.push_back({static_cast<std::uint32_t>(scan), static_cast<std::uint32_t>(i)});
    }
  }
  return points;
}

/// `count` of the items, evenly spread; all when there are not more.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& items, std::size_t count) {
  if (items.size() <= count) return items;
  std::vector<Item> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(items[i * items.size() / count]);
  return some;
}

/// Which point of which scan a point of the map is. Coordinates that are there twice lead to the first of them.
class PointsByPlace {
 public:
  explicit PointsByPlace(const RegisteredMap& map) {
    std::vector<std::uint32_t> next(map.num_scans, 0);
    for (std::size_t i = 0; i < map.points_in_map.size(); ++i) {
      const std::uint32_t scan = map.scan_of_point[i];
      points_.try_emplace(key_of(map.points_in_map[i]), ScanPoint{scan, next[scan]++});
    }
  }

  /// REQUIRES: `point_in_map` is a point of the map, to the bit.
  ScanPoint at(const Eigen::Vector3d& point_in_map) const { return points_.at(key_of(point_in_map)); }

 private:
  using Key = std::array<double, 3>;
  static Key key_of(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

  std::map<Key, ScanPoint> points_;
};

StudySubset subset_of(const RegisteredMap& map, const PointsByPlace& places, const StudySubsetSettings& subset,
                      double radius_m, std::size_t num_points_per_direction, const Execution& execution) {
  const OrthogonalSubsetResult found = extract_orthogonal_subset(map, radius_m, subset.extraction, execution);
  StudySubset result{.suffix = subset.suffix, .directions = {}, .reason = found.reason};
  for (const OrthogonalSubset::Direction& direction : found.subset.directions) {
    StudySubset::Direction some{direction.normal_in_map, {}};
    for (const Eigen::Vector3d& point : thinned(direction.points_in_map, num_points_per_direction)) {
      some.points.push_back(places.at(point));
    }
    result.directions.push_back(std::move(some));
  }
  return result;
}

}  // namespace

void StudyScene::validate() const {
  require_several_scans(points_in_scan.size());
  if (true_poses.size() != points_in_scan.size()) {
    throw InvalidArgument(std::to_string(points_in_scan.size()) + " scans but " + std::to_string(true_poses.size()) +
                          " poses: there must be one pose per scan");
  }
  require_points(*this, queries);
  for (const StudySubset& subset : subsets) {
    for (const StudySubset::Direction& direction : subset.directions) require_points(*this, direction.points);
  }
}

void StudySceneSettings::validate() const {
  if (num_queries < 1) throw InvalidArgument(out_of_range("num_queries", num_queries, ">= 1"));
  if (num_points_per_direction < 1) {
    throw InvalidArgument(out_of_range("num_points_per_direction", num_points_per_direction, ">= 1"));
  }
}

StudyScene scene_of_discs(std::span<const Disc> discs, std::size_t num_scans, const PlaneWorldSettings& world,
                          const StudySceneSettings& settings) {
  settings.validate();
  require_several_scans(num_scans);
  if (discs.size() < kNumDirections) throw InvalidArgument(out_of_range("number of discs", discs.size(), ">= 3"));
  StudyScene scene{
      .points_in_scan = {}, .true_poses = {std::vector<Pose>(num_scans), {}}, .queries = {}, .subsets = {}};
  const MemoryScans scans = observe_discs(discs, scene.true_poses, world);
  for (std::size_t i = 0; i < num_scans; ++i) scene.points_in_scan.push_back(scans.load(i).points_in_scan);
  scene.queries = evenly_spread(scene, settings.num_queries);
  StudySubset known;
  std::uint32_t first = 0;  // points stand disc by disc, those of a disc in random order
  for (std::size_t k = 0; k < kNumDirections; ++k) {
    const auto count = static_cast<std::uint32_t>(discs[k].num_points.value_or(world.points_per_disc));
    StudySubset::Direction direction{discs[k].normal_in_world, {}};
    for (std::uint32_t i = 0; i < count && i < settings.num_points_per_direction; ++i) {
      direction.points.push_back({0, first + i});
    }
    known.directions.push_back(std::move(direction));
    first += count;
  }
  scene.subsets.push_back(std::move(known));
  return scene;
}

StudyScene scene_of_scans(const ScanSequence& scans, const Trajectory& true_poses, std::size_t first,
                          std::size_t num_scans, std::span<const StudySubsetSettings> subsets, double radius_m,
                          const StudySceneSettings& settings, const Execution& execution) {
  settings.validate();
  require_several_scans(num_scans);
  if (first + num_scans > scans.size() || scans.size() != true_poses.size()) {
    throw InvalidArgument("scans " + std::to_string(first) + " to " + std::to_string(first + num_scans - 1) +
                          " were asked for, but there are " + std::to_string(scans.size()) + " and " +
                          std::to_string(true_poses.size()) + " poses");
  }
  StudyScene scene;
  std::vector<Scan> loaded;
  for (std::size_t i = first; i < first + num_scans; ++i) {
    loaded.push_back(scans.load(i));
    scene.points_in_scan.push_back(loaded.back().points_in_scan);
    scene.true_poses.world_from_scan.push_back(true_poses.world_from_scan[i]);
  }
  scene.queries = evenly_spread(scene, settings.num_queries);
  const RegisteredMap map = assemble_map(MemoryScans(std::move(loaded)), scene.true_poses, {}, execution).map;
  const PointsByPlace places(map);
  for (const StudySubsetSettings& subset : subsets) {
    scene.subsets.push_back(subset_of(map, places, subset, radius_m, settings.num_points_per_direction, execution));
  }
  return scene;
}

}  // namespace trysquare
