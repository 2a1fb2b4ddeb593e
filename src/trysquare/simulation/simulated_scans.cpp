// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/simulated_scans.h"

#include "trysquare/core/error.h"
#include "trysquare/synthetic/random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

constexpr std::uint64_t kNoiseStream = 0x6e6f697365;  ///< "noise": other numbers than the world and the drive.

/// A thing that moves: its surfaces, and a sphere about its origin that holds them.
struct Mover {
  MovingObject motion;  ///< Without the mesh.
  RayCaster surfaces;
  double radius_m = 0;
};

double radius_of(const TriangleMesh& mesh) {
  double radius_m = 0;
  for (const Eigen::Vector3d& vertex : mesh.vertices_in_world) radius_m = std::max(radius_m, vertex.norm());
  return radius_m;
}

Mover mover_of(const MovingObject& object) {
  if (object.path_in_world.size() < 2) throw InvalidArgument("the path of a moving object has less than two points");
  MovingObject motion = object;
  motion.mesh_in_object = {};
  return {std::move(motion), RayCaster(object.mesh_in_object), radius_of(object.mesh_in_object)};
}

/// The pose after `share` of the way from a to b at constant velocity; beyond 1 it goes on.
Pose between(const Pose& a, const Pose& b, double share) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(a.rotation.transpose() * b.rotation));
  return {a.rotation * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix(),
          a.translation + share * (b.translation - a.translation)};
}

void require_stamps(const Trajectory& trajectory) {
  const std::vector<std::int64_t>& stamps = trajectory.stamps_ns;
  if (!stamps.empty() && stamps.size() != trajectory.size()) {
    throw InvalidArgument("there are " + std::to_string(trajectory.size()) + " poses, but " +
                          std::to_string(stamps.size()) + " time stamps");
  }
  const auto not_later = std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>());
  if (not_later == stamps.end()) return;
  throw InvalidArgument("time stamp " + std::to_string(not_later - stamps.begin() + 1) +
                        " is not later than the one before");
}

}  // namespace

class SimulatedScans::Implementation {
 public:
  Implementation(const SimulatedWorld& world, Trajectory true_poses, const SensorModel& sensor, std::uint64_t seed)
      : trajectory(std::move(true_poses)),
        sensor_(sensor),
        seed_(seed),
        directions_in_scan_(ray_directions_in_scan(sensor)),
        surfaces_(world.mesh) {
    require_stamps(trajectory);
    for (const MovingObject& object : world.moving) movers_.push_back(mover_of(object));
  }

  Scan load(std::size_t index) const {
    std::vector<Pose> poses(1, trajectory.world_from_scan[index]);
    if (sensor_.rolling_shutter) poses = poses_of_columns(index);
    const std::vector<Ray> rays = rays_from(poses);
    std::vector<double> ranges_m(rays.size());
    surfaces_.cast(rays, sensor_.max_range_m, ranges_m);
    for (const Mover& mover : movers_) add(mover, time_s(index), rays, ranges_m);
    Scan scan = measured(ranges_m, Random(seed_, kNoiseStream + index));
    if (!trajectory.stamps_ns.empty()) scan.stamp_ns = trajectory.stamps_ns[index];
    return scan;
  }

  Trajectory trajectory;

 private:
  double time_s(std::size_t index) const {
    constexpr double kSecondsPerNanosecond = 1e-9;
    if (trajectory.stamps_ns.empty()) return static_cast<double>(index) * sensor_.period_s;
    return static_cast<double>(trajectory.stamps_ns[index] - trajectory.stamps_ns[0]) * kSecondsPerNanosecond;
  }

  /// Where the sensor is when it fires each column.
  std::vector<Pose> poses_of_columns(std::size_t index) const {
    const std::size_t num_columns = static_cast<std::size_t>(sensor_.num_azimuths);
    const Pose& pose = trajectory.world_from_scan[index];
    if (trajectory.size() == 1) return std::vector<Pose>(num_columns, pose);
    const std::size_t from = std::min(index, trajectory.size() - 2);
    const Pose& a = trajectory.world_from_scan[from];
    const Pose& b = trajectory.world_from_scan[from + 1];
    const double period = sensor_.period_s / (time_s(from + 1) - time_s(from));
    const double begin = index == from ? 0 : 1;
    std::vector<Pose> poses;
    for (std::size_t column = 0; column < num_columns; ++column) {
      const double share = static_cast<double>(column) / static_cast<double>(num_columns);
      poses.push_back(between(a, b, begin + period * share));
    }
    return poses;
  }

  /// @param world_from_column  One pose, or one for each column.
  std::vector<Ray> rays_from(std::span<const Pose> world_from_column) const {
    std::vector<Ray> rays;
    rays.reserve(directions_in_scan_.size());
    for (std::size_t i = 0; i < directions_in_scan_.size(); ++i) {
      const Pose& pose = world_from_column[i % world_from_column.size()];
      rays.push_back({pose.translation, pose.rotation * directions_in_scan_[i]});
    }
    return rays;
  }

  /// What a moving thing hides.
  void add(const Mover& mover, double now_s, std::span<const Ray> rays, std::span<double> ranges_m) const {
    const Pose world_from_object = mover.motion.world_from_object(now_s);
    const Pose object_from_world = rigid_inverse(world_from_object);
    if ((world_from_object.translation - rays[0].origin_in_world).norm() > 2 * sensor_.max_range_m + mover.radius_m) {
      return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d to_object = world_from_object.translation - rays[i].origin_in_world;
      const double along = to_object.dot(rays[i].direction_in_world);
      if (to_object.squaredNorm() - along * std::abs(along) > mover.radius_m * mover.radius_m) continue;
      const Ray ray_in_object{object_from_world * rays[i].origin_in_world,
                              object_from_world.rotation * rays[i].direction_in_world};
      ranges_m[i] = std::min(ranges_m[i], mover.surfaces.cast(ray_in_object, sensor_.max_range_m));
    }
  }

  /// Every return draws its numbers whether it is lost or not: dropout moves no other point.
  Scan measured(std::span<const double> ranges_m, Random random) const {
    Scan scan;
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
      if (ranges_m[i] == kNoReturn) continue;
      const double range_m = ranges_m[i] + sensor_.range_sigma_m * random.normal();
      const bool is_lost = random.uniform() < sensor_.dropout;
      if (is_lost || !(range_m > sensor_.min_range_m && range_m < sensor_.max_range_m)) continue;
      scan.points_in_scan.emplace_back(range_m * directions_in_scan_[i]);
    }
    return scan;
  }

  SensorModel sensor_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3d> directions_in_scan_;
  RayCaster surfaces_;
  std::vector<Mover> movers_;
};

SimulatedScans::SimulatedScans(const SimulatedWorld& world, Trajectory true_poses, const SensorModel& sensor,
                               std::uint64_t seed)
    : implementation_(std::make_unique<Implementation>(world, std::move(true_poses), sensor, seed)) {}
SimulatedScans::~SimulatedScans() = default;

std::size_t SimulatedScans::size() const { return implementation_->trajectory.size(); }

Scan SimulatedScans::load(std::size_t index) const {
  if (index < size()) return implementation_->load(index);
  throw InvalidArgument("index = " + std::to_string(index) + " is out of range: there are " + std::to_string(size()) +
                        " scans");
}

std::string SimulatedScans::name(std::size_t index) const { return "scan " + std::to_string(index); }

const Trajectory& SimulatedScans::true_poses() const { return implementation_->trajectory; }

}  // namespace trysquare
