// SPDX-License-Identifier: Apache-2.0
#include "trysquare/dataset/inputs.h"

#include "trysquare/core/error.h"
#include "trysquare/core/handedness.h"
#include "trysquare/core/some_scans.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/orthogonal_subset_file.h"
#include "trysquare/pipeline/sensor_trajectory.h"
#include "trysquare/trajectory/association.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace trysquare {
namespace {

namespace fs = std::filesystem;

/// Some scans of a sequence.
class SelectedScans : public ScanSequence {
 public:
  SelectedScans(ScanFiles all, std::vector<std::size_t> chosen, bool left_handed)
      : all_(std::move(all)), chosen_(std::move(chosen)), left_handed_(left_handed) {}
  std::size_t size() const override { return chosen_.size(); }
  Scan load(std::size_t index) const override {
    Scan scan = all_.load(chosen_.at(index));
    if (left_handed_) negate_y(scan.points_in_scan);
    return scan;
  }
  std::string name(std::size_t index) const override { return all_.name(chosen_.at(index)); }

 private:
  ScanFiles all_;
  std::vector<std::size_t> chosen_;
  bool left_handed_;
};

std::vector<std::size_t> select(std::size_t count, const InputOptions& options) {
  if (options.every < 1) throw InvalidArgument("every = 0 is out of range: it must be at least 1");
  const std::size_t last = options.last.value_or(count - 1);
  if (options.first > last || last >= count) {
    throw InvalidArgument(fmt::format("first = {}, last = {} selects no range of the {} scans (0 to {})", options.first,
                                      last, count, count - 1));
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = options.first; i <= last; i += options.every) {
    chosen.push_back(i);
    if (last - i < options.every) break;  // i + every may not fit into its type
  }
  return chosen;
}

[[noreturn]] void refuse_counts(const std::string& poses, std::size_t num_poses, const std::string& scans,
                                std::size_t num_scans, bool scans_have_times) {
  throw IoError(fmt::format("{}: {} poses for the {} scans of {}: there must be one pose per scan{}", poses, num_poses,
                            num_scans, scans,
                            scans_have_times ? ", or time stamps on both sides" : "; the scans carry no time stamps"));
}

/// The scans whose name is the number of a frame that has a pose. Nothing where a name holds no number.
std::optional<std::vector<std::size_t>> scans_with_frame(const ScanFiles& scans, const std::string& poses_name,
                                                         const std::vector<std::int64_t>& frames, Trajectory& poses,
                                                         std::vector<Diagnostic>& warnings) {
  std::unordered_map<std::int64_t, std::size_t> pose_of_frame;
  for (std::size_t i = 0; i < frames.size(); ++i) pose_of_frame.emplace(frames[i], i);
  std::vector<std::size_t> with_pose;
  std::vector<std::size_t> chosen_poses;
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    const std::optional<std::int64_t> frame = number_in_name(scans.paths()[scan]);
    if (!frame) return std::nullopt;
    const auto pose = pose_of_frame.find(*frame);
    if (pose == pose_of_frame.end()) continue;
    with_pose.push_back(scan);
    chosen_poses.push_back(pose->second);
  }
  if (with_pose.empty()) {
    const auto [first, last] = std::minmax_element(frames.begin(), frames.end());
    throw IoError(fmt::format("{}: its frames, {} to {}, are those of no scan; the first scan is {}", poses_name,
                              *first, *last, scans.paths().front().filename().string()));
  }
  if (with_pose.size() < scans.size()) {
    warnings.push_back({"scans_without_pose", fmt::format("{}: {} of {} scans have no pose with their frame number and "
                                                          "are left out",
                                                          poses_name, scans.size() - with_pose.size(), scans.size())});
  }
  poses = take(poses, chosen_poses);
  return with_pose;
}

/// The scans that have a pose, and the trajectory becomes the pose of each: by frame number where the poses have some,
/// by time where both sides have time stamps, or else in order.
std::vector<std::size_t> scans_with_pose(const ScanFiles& scans, const InputOptions& options,
                                         const std::string& poses_name, TrajectoryFile& file,
                                         std::vector<Diagnostic>& warnings) {
  Trajectory& poses = file.trajectory;
  if (!file.frames.empty()) {
    if (auto with_frame = scans_with_frame(scans, poses_name, file.frames, poses, warnings)) return *with_frame;
  }
  std::vector<std::size_t> with_pose;
  const bool have_times = !scans.stamps_ns().empty() && !poses.stamps_ns.empty();
  if (have_times) {
    const auto pose_of_scan = nearest_in_time(scans.stamps_ns(), poses.stamps_ns, options.max_time_difference_s);
    std::vector<std::size_t> chosen_poses;
    for (std::size_t scan = 0; scan < scans.size(); ++scan) {
      if (!pose_of_scan[scan]) continue;
      with_pose.push_back(scan);
      chosen_poses.push_back(*pose_of_scan[scan]);
    }
    if (!with_pose.empty()) {
      poses = take(poses, chosen_poses);
      if (with_pose.size() < scans.size()) {
        warnings.push_back(
            {"scans_without_pose",
             fmt::format("{}: {} of {} scans have no pose within {} s of their time and are left out", poses_name,
                         scans.size() - with_pose.size(), scans.size(), options.max_time_difference_s)});
      }
      return with_pose;
    }
  }
  const std::string no_common_time =
      fmt::format("{}: no pose lies within {} s of a scan", poses_name, options.max_time_difference_s);
  if (poses.size() != scans.size()) {
    if (have_times) throw IoError(no_common_time + ", see --t-max-diff");
    refuse_counts(poses_name, poses.size(), options.scans, scans.size(), !scans.stamps_ns().empty());
  }
  if (have_times) {
    warnings.push_back({"times_differ", no_common_time + "; as there is one pose per scan, they are taken in order"});
  }
  with_pose.resize(scans.size());
  std::iota(with_pose.begin(), with_pose.end(), std::size_t{0});
  return with_pose;
}

/// What takes the poses of `poses_spec` to the sensor: as asked for, or else the calib.txt beside them.
std::optional<Extrinsic> find_extrinsic(const InputOptions& options, const std::string& poses_spec) {
  if (!options.extrinsic.empty() && !options.calibration.empty()) {
    throw InvalidArgument("extrinsic and calib exclude each other");
  }
  if (!options.calibration.empty() && options.no_calibration) {
    throw InvalidArgument("calib and no_calib exclude each other");
  }
  if (!options.extrinsic.empty()) {
    return Extrinsic{read_extrinsic(options.extrinsic), options.extrinsic, false};
  }
  fs::path calibration = options.calibration;
  if (calibration.empty() && !options.no_calibration) {
    std::error_code ignored;  // what is not there is no folder
    const fs::path poses = poses_spec;
    const fs::path folder = fs::is_directory(poses, ignored) ? poses : poses.parent_path();
    if (fs::exists(folder / "calib.txt", ignored)) calibration = folder / "calib.txt";
  }
  if (calibration.empty()) return std::nullopt;
  return Extrinsic{read_kitti_calibration(calibration), calibration.filename().string() + ":Tr", true};
}

/// What CARLA writes is left-handed, whoever forgets to say so.
void warn_of_handedness(const TrajectoryFile& file, const InputOptions& options, std::vector<Diagnostic>& warnings) {
  if (file.format != TrajectoryFormat::kCarla || options.left_handed) return;
  warnings.push_back({"left_handed_poses",
                      "transforms of CARLA are left-handed: with scans as CARLA wrote them, too, the metrics are right "
                      "and the map is a mirror image; with right-handed scans they mean nothing; see --left-handed"});
}

void append(std::vector<Diagnostic>& warnings, const std::vector<Diagnostic>& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

Trajectory right_handed_sensor_poses(const Trajectory& as_read, const std::optional<Extrinsic>& extrinsic,
                                     const InputOptions& options) {
  Trajectory poses = extrinsic ? extrinsic->apply(as_read) : as_read;
  return options.left_handed ? with_y_negated(std::move(poses)) : poses;
}

}  // namespace

Trajectory Extrinsic::apply(const Trajectory& world_from_body) const {
  return moves_world_along ? sensor_trajectory_in_sensor_world(world_from_body, body_from_sensor)
                           : sensor_trajectory(world_from_body, body_from_sensor);
}

Trajectory Extrinsic::undo(const Trajectory& world_from_sensor) const {
  const Pose sensor_from_body = general_inverse(body_from_sensor);
  return moves_world_along ? sensor_trajectory_in_sensor_world(world_from_sensor, sensor_from_body)
                           : sensor_trajectory(world_from_sensor, sensor_from_body);
}

Trajectory poses_as_in_file(const Trajectory& world_from_scan, const Inputs& inputs, const InputOptions& options) {
  Trajectory poses = inputs.extrinsic ? inputs.extrinsic->undo(world_from_scan) : world_from_scan;
  return options.left_handed ? with_y_negated(std::move(poses)) : poses;
}

std::vector<std::string> poses_formats() {
  return {"auto", "kitti", "tum", "euroc", "matrix", "carla", "nclt", "mulran", "newer-college", "g2o", "balm"};
}

std::optional<TrajectoryFormat> format_option(const std::string& name) {
  if (name == "auto") return std::nullopt;
  if (const std::optional<TrajectoryFormat> format = trajectory_format_named(name)) return format;
  std::string known;
  for (const std::string& each : poses_formats()) known += " " + each;
  throw InvalidArgument(fmt::format("poses_format = '{}' is not known: expected one of{}", name, known));
}

OrthogonalSubset read_subset(const std::string& spec) {
  OrthogonalSubset subset;
  for (std::vector<Eigen::Vector3d>& points : read_point_groups(spec)) {
    subset.directions.push_back({.points_in_map = std::move(points)});
  }
  if (subset.directions.size() > 3) {
    throw IoError(
        fmt::format("{}: {} files, at most 3 were expected: one per direction", spec, subset.directions.size()));
  }
  return subset;
}

std::unique_ptr<ScanSequence> load_scans(const InputOptions& options) {
  ScanFiles scans = open_scans(options.scans);
  std::vector<std::size_t> chosen = select(scans.size(), options);
  return std::make_unique<SelectedScans>(std::move(scans), std::move(chosen), options.left_handed);
}

Inputs load_inputs(const InputOptions& options) {
  ScanFiles scans = open_scans(options.scans);
  TrajectoryFile file = read_trajectory(options.poses, format_option(options.poses_format));
  Inputs inputs{.format = file.format, .warnings = std::move(file.warnings)};
  inputs.extrinsic = find_extrinsic(options, options.poses);
  warn_of_handedness(file, options, inputs.warnings);

  inputs.all_poses = right_handed_sensor_poses(file.trajectory, inputs.extrinsic, options);
  const std::vector<std::size_t> with_pose = scans_with_pose(scans, options, options.poses, file, inputs.warnings);
  const std::vector<std::size_t> chosen = select(with_pose.size(), options);
  inputs.poses_as_read = take(file.trajectory, chosen);
  inputs.world_from_scan = right_handed_sensor_poses(inputs.poses_as_read, inputs.extrinsic, options);
  if (inputs.extrinsic && options.left_handed) {
    inputs.extrinsic->body_from_sensor = with_y_negated(inputs.extrinsic->body_from_sensor);
  }

  if (!options.reference.empty()) {
    TrajectoryFile reference = read_trajectory(options.reference, format_option(options.poses_format));
    append(inputs.warnings, reference.warnings);
    std::vector<Diagnostic> no_more_warnings;
    const auto of_reference = scans_with_pose(scans, options, options.reference, reference, no_more_warnings);
    if (of_reference != with_pose) {
      throw IoError(
          fmt::format("{}: the reference has poses for other scans than {}", options.reference, options.poses));
    }
    const Trajectory chosen_poses = take(reference.trajectory, chosen);
    inputs.reference_extrinsic = find_extrinsic(options, options.reference);
    inputs.reference = right_handed_sensor_poses(chosen_poses, inputs.reference_extrinsic, options);
  }
  std::vector<std::size_t> chosen_scans;
  for (const std::size_t i : chosen) chosen_scans.push_back(with_pose[i]);
  inputs.scans = std::make_unique<SelectedScans>(std::move(scans), std::move(chosen_scans), options.left_handed);
  return inputs;
}

namespace {

/// Scans that all have a pose for, each list ascending.
std::vector<std::size_t> common_scans(const std::vector<std::vector<std::size_t>>& with_pose) {
  std::vector<std::size_t> common = with_pose.front();
  for (const std::vector<std::size_t>& more : with_pose) {
    std::vector<std::size_t> both;
    std::set_intersection(common.begin(), common.end(), more.begin(), more.end(), std::back_inserter(both));
    common = std::move(both);
  }
  return common;
}

/// Where the chosen scans are in a list that holds them all.
std::vector<std::size_t> places_in(const std::vector<std::size_t>& scans, const std::vector<std::size_t>& chosen) {
  std::vector<std::size_t> places;
  for (const std::size_t scan : chosen) {
    places.push_back(static_cast<std::size_t>(std::lower_bound(scans.begin(), scans.end(), scan) - scans.begin()));
  }
  return places;
}

}  // namespace

ComparedInputs load_compared_inputs(const InputOptions& options, const std::vector<std::string>& poses) {
  ScanFiles scans = open_scans(options.scans);
  ComparedInputs inputs;
  std::vector<std::vector<std::size_t>> with_pose;
  std::vector<Trajectory> as_read;
  for (const std::string& each : poses) {
    TrajectoryFile file = read_trajectory(each, format_option(options.poses_format));
    ComparedInputs::Poses& loaded = inputs.trajectories.emplace_back();
    loaded.poses = each;
    loaded.format = file.format;
    loaded.warnings = std::move(file.warnings);
    loaded.extrinsic = find_extrinsic(options, each);
    warn_of_handedness(file, options, loaded.warnings);
    with_pose.push_back(scans_with_pose(scans, options, each, file, loaded.warnings));
    as_read.push_back(std::move(file.trajectory));
  }
  const std::vector<std::size_t> common = common_scans(with_pose);
  if (common.empty())
    throw IoError(fmt::format("{}: no scan has a pose in each of the {} files", options.scans, poses.size()));
  std::vector<std::size_t> chosen;
  for (const std::size_t i : select(common.size(), options)) chosen.push_back(common[i]);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ComparedInputs::Poses& loaded = inputs.trajectories[i];
    loaded.world_from_scan =
        right_handed_sensor_poses(take(as_read[i], places_in(with_pose[i], chosen)), loaded.extrinsic, options);
    if (loaded.extrinsic && options.left_handed) {
      loaded.extrinsic->body_from_sensor = with_y_negated(loaded.extrinsic->body_from_sensor);
    }
  }
  inputs.scans = std::make_unique<SelectedScans>(std::move(scans), std::move(chosen), options.left_handed);
  return inputs;
}

}  // namespace trysquare
