// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/write_trajectory.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cstdint>

namespace trysquare {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

void validate(const Trajectory& trajectory) {
  if (trajectory.size() == 0) throw InvalidArgument("trajectory has no poses, expected one or more");
  if (!trajectory.stamps_ns.empty() && trajectory.stamps_ns.size() != trajectory.size()) {
    throw InvalidArgument(fmt::format("trajectory has {} time stamps, expected none or {}, one for each pose",
                                      trajectory.stamps_ns.size(), trajectory.size()));
  }
}

std::int64_t stamp_ns(const Trajectory& trajectory, std::size_t index) {
  return trajectory.stamps_ns.empty() ? static_cast<std::int64_t>(index) * kNanosecondsPerSecond
                                      : trajectory.stamps_ns[index];
}

std::string seconds(std::int64_t stamp_ns) {
  const std::int64_t whole = stamp_ns / kNanosecondsPerSecond;
  const std::int64_t rest = stamp_ns % kNanosecondsPerSecond;
  return fmt::format("{}{}.{:09}", stamp_ns < 0 ? "-" : "", whole < 0 ? -whole : whole, rest < 0 ? -rest : rest);
}

std::string number(double value) { return fmt::format("{:.17g}", value); }

std::string position(const Pose& pose, char separator) {
  const Eigen::Vector3d& t = pose.translation;
  return number(t.x()) + separator + number(t.y()) + separator + number(t.z());
}

std::string row(const Pose& pose, Eigen::Index i) {
  const Eigen::Matrix3d& r = pose.rotation;
  return fmt::format("{} {} {} {}", number(r(i, 0)), number(r(i, 1)), number(r(i, 2)), number(pose.translation[i]));
}

std::string line_of(const Trajectory& trajectory, std::size_t index, TrajectoryFormat format) {
  const Pose& pose = trajectory.world_from_scan[index];
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.rotation).normalized();
  switch (format) {
    case TrajectoryFormat::kTum:
      return fmt::format("{} {} {} {} {} {}\n", seconds(stamp_ns(trajectory, index)), position(pose, ' '),
                         number(q.x()), number(q.y()), number(q.z()), number(q.w()));
    case TrajectoryFormat::kEuroc:
      return fmt::format("{},{},{},{},{},{}\n", stamp_ns(trajectory, index), position(pose, ','), number(q.w()),
                         number(q.x()), number(q.y()), number(q.z()));
    case TrajectoryFormat::kKitti:
      return fmt::format("{} {} {}\n", row(pose, 0), row(pose, 1), row(pose, 2));
    default:
      break;
  }
  return fmt::format("{}\n{}\n{}\n0 0 0 1\n", row(pose, 0), row(pose, 1), row(pose, 2));
}

}  // namespace

bool can_be_written(TrajectoryFormat format) {
  return format == TrajectoryFormat::kTum || format == TrajectoryFormat::kKitti || format == TrajectoryFormat::kEuroc ||
         format == TrajectoryFormat::kMatrices;
}

std::string format_trajectory(const Trajectory& trajectory, TrajectoryFormat format) {
  validate(trajectory);
  if (!can_be_written(format)) {
    throw InvalidArgument(fmt::format("trajectories of the format {} are read, but not written", name_of(format)));
  }
  std::string text;
  if (format == TrajectoryFormat::kTum) text = "# timestamp tx ty tz qx qy qz qw\n";
  if (format == TrajectoryFormat::kEuroc) {
    text = "#timestamp [ns], p_x [m], p_y [m], p_z [m], q_w [], q_x [], q_y [], q_z []\n";
  }
  for (std::size_t i = 0; i < trajectory.size(); ++i) text += line_of(trajectory, i, format);
  return text;
}

void write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory, TrajectoryFormat format) {
  write_file(path, format_trajectory(trajectory, format));
}

}  // namespace trysquare
