// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/ray_caster.h"

#include "trysquare/core/error.h"

#include <Eigen/Geometry>
#if TRYSQUARE_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace trysquare {
namespace {

constexpr std::size_t kPacket = 8;  ///< Rays that are searched together.

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Plane n · x = offset of a triangle, about the center of the mesh.
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0;
};

Eigen::Vector3d center_of(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  return box.center();
}

void require_no_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw Error("Embree failed with error " + std::to_string(static_cast<int>(error)));
}

void intersect(const std::array<int, kPacket>& valid, RTCScene scene, RTCRayHit8& rays) {
#if TRYSQUARE_EMBREE_MAJOR >= 4
  rtcIntersect8(valid.data(), scene, &rays, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), scene, &context, &rays);
#endif
}

}  // namespace

/// The mesh about its center, once for the search and once for the distance.
class RayCaster::Scene {
 public:
  explicit Scene(const TriangleMesh& mesh)
      : center_(center_of(mesh.vertices_in_world)), device_(rtcNewDevice(nullptr)) {
    if (!device_) require_no_error(nullptr);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no gaps between triangles that share an edge
    add(mesh);
    rtcCommitScene(scene_.get());
    require_no_error(device_.get());
  }

  /// At most kPacket rays.
  void cast(std::span<const Ray> rays, double max_range_m, std::span<double> ranges_m) const {
    alignas(32) std::array<int, kPacket> valid{};
    alignas(32) RTCRayHit8 packet{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      valid[i] = -1;
      put(rays[i], static_cast<float>(max_range_m), i, packet);
    }
    intersect(valid, scene_.get(), packet);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      ranges_m[i] =
          hit ? refined_range(rays[i], packet.hit.primID[i], static_cast<double>(packet.ray.tfar[i])) : kNoReturn;
    }
  }

 private:
  void add(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices_in_world.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
      rtcReleaseGeometry(geometry);
      throw std::bad_alloc();
    }
    for (const Eigen::Vector3d& vertex : mesh.vertices_in_world) {
      for (const double coordinate : Eigen::Vector3d(vertex - center_)) *vertices++ = static_cast<float>(coordinate);
    }
    for (const auto& triangle : mesh.triangles) indices = std::copy(triangle.begin(), triangle.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    keep_planes(mesh);
  }

  void keep_planes(const TriangleMesh& mesh) {
    planes_.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
      const Eigen::Vector3d a = mesh.vertices_in_world[triangle[0]] - center_;
      const Eigen::Vector3d b = mesh.vertices_in_world[triangle[1]] - center_;
      const Eigen::Vector3d c = mesh.vertices_in_world[triangle[2]] - center_;
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      planes_.push_back({normal, normal.dot(a)});
    }
  }

  void put(const Ray& ray, float max_range_m, std::size_t i, RTCRayHit8& packet) const {
    const Eigen::Vector3f origin = (ray.origin_in_world - center_).cast<float>();
    const Eigen::Vector3f direction = ray.direction_in_world.cast<float>();
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    packet.ray.dir_x[i] = direction.x();
    packet.ray.dir_y[i] = direction.y();
    packet.ray.dir_z[i] = direction.z();
    packet.ray.tnear[i] = 0;
    packet.ray.tfar[i] = max_range_m;
    packet.ray.mask[i] = 0xffffffffU;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }

  /// Where the ray meets the plane of the triangle. Along the plane, and beside a triangle that only rounding lets it
  /// hit, that can be anywhere: then what single precision found stands.
  double refined_range(const Ray& ray, std::uint32_t triangle, double found_m) const {
    constexpr double kPlausible = 1e-3;
    const Plane& plane = planes_[triangle];
    const double approach = plane.normal.dot(ray.direction_in_world);
    const double range_m = (plane.offset - plane.normal.dot(ray.origin_in_world - center_)) / approach;
    return std::abs(range_m - found_m) < kPlausible * (1 + found_m) ? range_m : found_m;
  }

  Eigen::Vector3d center_;
  Device device_;
  EmbreeScene scene_;
  std::vector<Plane> planes_;
};

RayCaster::RayCaster(const TriangleMesh& mesh_in_world) {
  mesh_in_world.validate();
  scene_ = std::make_unique<Scene>(mesh_in_world);
}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::cast(std::span<const Ray> rays, double max_range_m, std::span<double> ranges_m) const {
  if (rays.size() != ranges_m.size()) {
    throw InvalidArgument("there are " + std::to_string(rays.size()) + " rays, but room for " +
                          std::to_string(ranges_m.size()) + " ranges");
  }
  for (std::size_t begin = 0; begin < rays.size(); begin += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - begin);
    scene_->cast(rays.subspan(begin, count), max_range_m, ranges_m.subspan(begin, count));
  }
}

double RayCaster::cast(const Ray& ray, double max_range_m) const {
  double range_m = kNoReturn;
  cast({&ray, 1}, max_range_m, {&range_m, 1});
  return range_m;
}

}  // namespace trysquare
