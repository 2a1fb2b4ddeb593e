// SPDX-License-Identifier: Apache-2.0
// How good the estimate of the RPE without ground truth is: one set of trajectories a call, one table row a scene.
#include "trysquare/adjustment/adjust_poses.h"
#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/core/error.h"
#include "trysquare/experiments/estimate_study.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/neighborhood/point_index.h"
#include "trysquare/pipeline/sensor_trajectory.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/simulated_scans.h"
#include "trysquare/synthetic/memory_scans.h"
#include "trysquare/trajectory/all_pairs_rpe.h"
#include "trysquare/trajectory/rpe.h"

#include "process_usage.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kRangeOfBody_m = 2.8;  ///< KITTI: nearer points are the car that carries the sensor.
constexpr std::array kTowns = {WorldStyle::kStreet, WorldStyle::kTownGrid, WorldStyle::kTownSuburb,
                               WorldStyle::kTownOld};
constexpr std::array kNames = {"street", "grid", "suburb", "old town"};

struct Options {
  std::string set;
  std::string kitti;
  std::string other_poses;
  std::string depth;
  std::string samples;
  std::string model = "white";
  std::vector<std::size_t> lengths;  ///< Empty: those of the set.
  std::size_t first_world = 0;
  std::size_t num_worlds = 4;
  std::size_t num_trajectories = 30;
  std::size_t num_patches_per_source = AdjustmentSettings{}.max_patches_per_source;
  double translation_m = 0.05;
  double rotation_deg = 0.2;
  double least_factor = 0.1;
  double most_factor = 2;
  std::vector<double> outliers_m = {0.05, 0.1};
  std::uint64_t seed = 0;
  int num_threads = 1;

  std::vector<std::size_t> lengths_or(std::vector<std::size_t> usual) const {
    return lengths.empty() ? usual : lengths;
  }

  Execution execution() const { return {.num_threads = num_threads}; }

  EstimateStudySettings study() const {
    EstimateStudySettings result;
    result.noise = {.translation_sigma_m = translation_m,
                    .rotation_sigma_rad = rotation_deg * kRadiansPerDegree,
                    .seed = seed,
                    .model = *noise_model_named(model)};
    result.least_factor = least_factor;
    result.most_factor = most_factor;
    result.adjustment.max_patches_per_source = num_patches_per_source;
    return result;
  }
};

/// Scans in memory and the poses that they were taken from.
struct Scene {
  std::string name;
  MemoryScans scans{{}};
  Trajectory true_poses{};

  /// The first scans of it.
  Scene first(std::size_t num_scans) const {
    Scene result{.name = name};
    std::vector<Scan> some;
    for (std::size_t i = 0; i < num_scans; ++i) {
      some.push_back(scans.load(i));
      result.true_poses.world_from_scan.push_back(true_poses.world_from_scan[i]);
    }
    result.scans = MemoryScans(std::move(some));
    return result;
  }
};

MemoryScans in_memory(const ScanSequence& sequence, std::size_t num_scans) {
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < num_scans; ++i) scans.push_back(sequence.load(i));
  return MemoryScans(std::move(scans));
}

/// Drive number `number` through a town: all four kinds in turn.
Scene town_scene(std::size_t number, std::size_t num_scans, std::uint64_t seed) {
  const std::size_t kind = number % kTowns.size();
  const SimulatedWorld world = make_world(kTowns.at(kind), seed + number);
  const Trajectory poses = drive(world, {.num_scans = num_scans, .seed = seed + number});
  const SimulatedScans scans(world, poses, sensor_preset("carla32"), seed + number);
  return {.name = fmt::format("{} {}", kNames.at(kind), number / kTowns.size()),
          .scans = in_memory(scans, num_scans),
          .true_poses = poses};
}

/// The points of scans in every other field of a checkerboard of the map.
MemoryScans one_color(const MemoryScans& scans, const Trajectory& poses, double field_m, bool is_white) {
  std::vector<Scan> parts;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Pose map_from_scan = general_inverse(poses.world_from_scan.front()) * poses.world_from_scan[i];
    Scan part;
    for (const Eigen::Vector3d& point_in_scan : scans.load(i).points_in_scan) {
      const Eigen::Vector3d field = ((map_from_scan * point_in_scan) / field_m).array().floor();
      if ((std::fmod(std::abs(field.sum()), 2) < 0.5) == is_white) part.points_in_scan.push_back(point_in_scan);
    }
    parts.push_back(std::move(part));
  }
  return MemoryScans(std::move(parts));
}

/// What KITTI says itself: the poses of the sensor by GNSS and INS.
Scene kitti_as_it_is(const Options& options, std::size_t num_scans) {
  if (options.kitti.empty()) throw InvalidArgument("--kitti SEQUENCE is needed: velodyne/, poses.txt, calib.txt");
  Scene scene{.name = "KITTI 00"};
  scene.scans = in_memory(open_scans(options.kitti + "/velodyne"), num_scans);
  scene.true_poses = sensor_trajectory_in_sensor_world(read_trajectory(options.kitti + "/poses.txt").trajectory,
                                                       read_kitti_calibration(options.kitti + "/calib.txt"));
  scene.true_poses.world_from_scan.resize(num_scans);
  return scene;
}

Trajectory adjusted_by(const MemoryScans& scans, const Trajectory& poses, const Options& options) {
  AdjustmentSettings settings;
  settings.min_range_m = kRangeOfBody_m;
  const RpeEstimate estimate = estimate_rpe(scans, poses, settings, options.execution());
  if (estimate.adjusted.size() == poses.size()) return estimate.adjusted;
  throw InvalidArgument("the scans cannot be adjusted: " + estimate.reasons.front());
}

/// KITTI scans on the black fields of a checkerboard. The truth is what the surfaces on the white fields say.
Scene kitti_scene(const Options& options, std::size_t num_scans) {
  constexpr double kField_m = 6;  // Not the 3 m at which an estimate halves its patches: both halves need some.
  Scene whole = kitti_as_it_is(options, num_scans);
  const Trajectory adjusted = adjusted_by(whole.scans, whole.true_poses, options);
  Scene scene{.name = "KITTI 00"};
  scene.true_poses = adjusted_by(one_color(whole.scans, adjusted, kField_m, true), adjusted, options);
  scene.scans = one_color(whole.scans, adjusted, kField_m, false);
  return scene;
}

// ---- Tables ---------------------------------------------------------------------------------------------------------

std::string number(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "–";
}

std::string percent(const std::optional<double>& value) { return value ? fmt::format("{:.2f} %", 100 * *value) : "–"; }

void print_quality_header() {
  fmt::print(
      "| scene | N | trajectories | measured / bound / refused | wrong | Pearson | Kendall | Pearson, rotation | slope "
      "| median error | interval holds | of rotation | ± width "
      "|\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

void print_quality(const std::string& name, std::size_t num_poses, const EstimateQuality& quality) {
  fmt::print("| {} | {} | {} | {} / {} / {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, num_poses,
             quality.num_samples, quality.num_measured, quality.num_bounds, quality.num_refused, quality.num_wrong,
             number(quality.pearson, "{:.4f}"), number(quality.kendall, "{:.3f}"),
             number(quality.rotation_pearson, "{:.4f}"), number(quality.slope, "{:.4f}"), percent(quality.median_error),
             percent(quality.coverage), percent(quality.rotation_coverage), percent(quality.median_width));
  std::fflush(stdout);
}

std::string interval(const std::optional<std::array<double, 2>>& ends, double unit) {
  return ends ? fmt::format("{:.6f},{:.6f}", (*ends)[0] / unit, (*ends)[1] / unit) : ",";
}

std::string flag(const std::optional<bool>& value) { return value ? (*value ? "1" : "0") : ""; }

std::string in_degrees(const std::optional<double>& rad) {
  return rad ? fmt::format("{:.6f}", *rad / kRadiansPerDegree) : "";
}

/// Appends a line to the file of samples, if there is one: a long study that is stopped has not been in vain.
void write_sample(const Scene& scene, std::size_t number_of_sample, const EstimateSample& sample,
                  const Options& options) {
  if (options.samples.empty()) return;
  std::ofstream out(options.samples, std::ios::app);
  if (out.tellp() == 0) {
    out << "set,model,scene,poses,number,true_m,true_deg,status,estimate_m,estimate_deg,low_m,high_m,low_deg,high_deg,"
           "bound_m,outlier_found,outlier_farthest,outlier_suspect,good_poses,false_suspects\n";
  }
  const auto text = [](const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : ""; };
  out << fmt::format("{},{},{},{},{},{:.6f},{:.6f},{},{},{},{},{},{},{},{},{},{},{}\n", options.set, options.model,
                     scene.name, scene.true_poses.size(), number_of_sample, sample.true_m,
                     sample.true_rad / kRadiansPerDegree, name_of(sample.status), text(sample.estimate_m),
                     in_degrees(sample.estimate_rad), interval(sample.interval_m, 1),
                     interval(sample.interval_rad, kRadiansPerDegree), text(sample.upper_bound_m),
                     flag(sample.outlier_has_top_score), flag(sample.outlier_is_farthest),
                     sample.outlier_is_suspect ? 1 : 0, sample.num_good_poses, sample.num_false_suspects);
  if (!out) throw IoError(options.samples + ": cannot be written");
}

/// @param number_of_scene  Scenes of different numbers get different errors.
std::vector<EstimateSample> samples_of(const Scene& scene, std::size_t number_of_scene,
                                       const EstimateStudySettings& study, const Options& options) {
  std::vector<EstimateSample> samples;
  const std::size_t first = number_of_scene * options.num_trajectories;
  for (std::size_t k = first; k < first + options.num_trajectories; ++k) {
    samples.push_back(estimate_sample(scene.scans, scene.true_poses, disturb(scene.true_poses, study, k),
                                      study.adjustment, options.execution()));
    write_sample(scene, k, samples.back(), options);
    if (samples.back().status != EstimateStatus::kRefused) continue;
    fmt::print(stderr, "{}, {} poses, trajectory {}: {}\n", scene.name, scene.true_poses.size(), k,
               fmt::join(samples.back().reasons, "; "));
  }
  return samples;
}

/// What was said about the consecutive poses of each sample.
std::vector<EstimateSample> consecutive(const std::vector<EstimateSample>& samples) {
  std::vector<EstimateSample> result;
  for (const EstimateSample& sample : samples) {
    result.push_back(sample.by_pairs.empty() ? EstimateSample{} : sample.by_pairs.front());
  }
  return result;
}

void run_towns(const Options& options) {
  print_quality_header();
  for (const std::size_t num_poses : options.lengths_or({5, 15, 30})) {
    std::vector<EstimateSample> all;
    for (std::size_t world = options.first_world; world < options.num_worlds; ++world) {
      const Scene scene = town_scene(world, num_poses, options.seed);
      const std::vector<EstimateSample> samples = samples_of(scene, world, options.study(), options);
      print_quality(scene.name, num_poses, quality_of(samples));
      all.insert(all.end(), samples.begin(), samples.end());
    }
    print_quality("**all**", num_poses, quality_of(all));
    print_quality("**all**, consecutive", num_poses, quality_of(consecutive(all)));
  }
}

void run_kitti(const Options& options) {
  EstimateStudySettings study = options.study();
  study.adjustment.min_range_m = kRangeOfBody_m;
  print_quality_header();
  std::vector<std::string> floors;
  for (const std::size_t num_poses : options.lengths_or({5, 10})) {
    const Scene scene = kitti_scene(options, num_poses);
    const EstimateSample floor = estimate_sample(scene.scans, scene.true_poses, {.given = scene.true_poses},
                                                 study.adjustment, options.execution());
    floors.push_back(fmt::format(
        "N = {}, truth as it is: {}, estimate {} mm, {}°, bound {} mm", num_poses, name_of(floor.status),
        number(floor.estimate_m ? std::optional(1000 * *floor.estimate_m) : std::nullopt, "{:.1f}"),
        number(floor.estimate_rad ? std::optional(*floor.estimate_rad / kRadiansPerDegree) : std::nullopt, "{:.3f}"),
        number(floor.upper_bound_m ? std::optional(1000 * *floor.upper_bound_m) : std::nullopt, "{:.1f}")));
    const std::vector<EstimateSample> samples = samples_of(scene, 0, study, options);
    print_quality(scene.name, num_poses, quality_of(samples));
    print_quality(scene.name + ", consecutive", num_poses, quality_of(consecutive(samples)));
  }
  for (const std::string& floor : floors) fmt::print("\n{}\n", floor);
}

void run_outliers(const Options& options) {
  constexpr std::size_t kNumPoses = 10;
  fmt::print(
      "| scene | moved by | trajectories | refused | largest translation | top score | a suspect | good poses "
      "suspected |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const double outlier_m : options.outliers_m) {
    EstimateStudySettings study = options.study();
    study.noise.translation_sigma_m = 0.01;
    study.noise.rotation_sigma_rad = 0.05 * kRadiansPerDegree;
    study.least_factor = study.most_factor = 1;
    study.outlier_m = outlier_m;
    std::vector<EstimateSample> all;
    const auto add = [&](const Scene& scene, std::size_t number_of_scene) {
      const std::vector<EstimateSample> samples = samples_of(scene, number_of_scene, study, options);
      all.insert(all.end(), samples.begin(), samples.end());
    };
    const auto print = [&](const char* name) {
      const EstimateQuality quality = quality_of(all);
      fmt::print("| {} | {:.0f} cm | {} | {} | {} | {} | {} | {} |\n", name, 100 * outlier_m, quality.num_samples,
                 quality.num_refused, percent(quality.outliers_farthest), percent(quality.outliers_found),
                 percent(quality.outliers_suspected), percent(quality.false_suspects));
      std::fflush(stdout);
    };
    for (std::size_t world = options.first_world; world < options.num_worlds; ++world)
      add(town_scene(world, kNumPoses, options.seed), world);
    print("towns");
    if (options.kitti.empty()) continue;
    all.clear();
    study.adjustment.min_range_m = kRangeOfBody_m;
    add(kitti_scene(options, kNumPoses), options.num_worlds);
    print("KITTI 00");
  }
}

// ---- Refusals -------------------------------------------------------------------------------------------------------

/// What a case should get.
enum class Due { kNumber, kAnything, kRefusal };

/// Counts cases as they are printed.
struct RefusalSuite {
  const Options& options;
  std::size_t num_cases = 0;
  std::size_t num_wrong = 0;
  std::size_t num_wrong_pairs = 0;  ///< Of pairs of poses that some distance is between.
  std::size_t num_rescued = 0;      ///< Refused, but not for all of these pairs.
  std::size_t num_due = 0;          ///< Cases that should get a number.
  std::size_t num_false_refusals = 0;

  void judge(const std::string& name, const EstimateSample& sample, Due due) {
    ++num_cases;
    const bool is_refused = sample.status == EstimateStatus::kRefused;
    const bool is_wrong =
        is_wrong_acceptance(sample) || (due == Due::kRefusal && !is_refused && std::isnan(sample.true_m));
    num_wrong += is_wrong ? 1U : 0U;
    bool is_rescued = false;
    for (const EstimateSample& pairs : sample.by_pairs) {
      num_wrong_pairs += is_wrong_acceptance(pairs) ? 1U : 0U;
      is_rescued = is_rescued || (is_refused && pairs.status != EstimateStatus::kRefused);
      if (is_wrong_acceptance(pairs)) {
        fmt::print(stderr, "{}: wrong for some pairs: true {:.4f} m, {} {}\n", name, pairs.true_m,
                   name_of(pairs.status), number(pairs.estimate_m, "{:.4f}"));
      }
    }
    num_rescued += is_rescued ? 1U : 0U;
    num_due += due == Due::kNumber ? 1U : 0U;
    num_false_refusals += due == Due::kNumber && is_refused ? 1U : 0U;
    fmt::print("| {} | {:.4f} | {} | {} | {} | {}{}{} |\n", name, sample.true_m, name_of(sample.status),
               number(sample.estimate_m, "{:.4f}"), number(sample.upper_bound_m, "{:.4f}"), is_wrong ? "**wrong**" : "",
               due == Due::kNumber && is_refused ? "false refusal: " : "", fmt::join(sample.reasons, "; "));
    std::fflush(stdout);
  }

  EstimateSample sample(const Scene& scene, const Trajectory& given, const AdjustmentSettings& settings) const {
    return estimate_sample(scene.scans, scene.true_poses, {.given = given}, settings, options.execution());
  }
};

/// Errors from a centimetre to two metres per axis. Where the true RPE is a metre or less there should be a number.
void judge_perturbations(const Scene& scene, AdjustmentSettings adjustment, RefusalSuite& suite) {
  constexpr double kCaptured_m = 1;
  std::size_t number = 0;
  for (const double sigma_m : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) {
    EstimateStudySettings study{.least_factor = 1, .most_factor = 1};
    study.noise = {.translation_sigma_m = sigma_m,
                   .rotation_sigma_rad = std::min(4 * sigma_m, 1.0) * kRadiansPerDegree,
                   .seed = suite.options.seed + 1};
    const DisturbedTrajectory disturbed = disturb(scene.true_poses, study, number++);
    const EstimateSample sample =
        estimate_sample(scene.scans, scene.true_poses, disturbed, adjustment, suite.options.execution());
    suite.judge(fmt::format("{}, {} m per axis", scene.name, sigma_m), sample,
                sample.true_m <= kCaptured_m ? Due::kNumber : Due::kAnything);
  }
}

Trajectory inverse_of(Trajectory trajectory) {
  for (Pose& pose : trajectory.world_from_scan) pose = general_inverse(pose);
  return trajectory;
}

Trajectory shifted(Trajectory trajectory, std::ptrdiff_t by) {
  auto& poses = trajectory.world_from_scan;
  std::rotate(poses.begin(), poses.begin() + by, poses.end());
  return trajectory;
}

Trajectory permuted(Trajectory trajectory) {
  auto& poses = trajectory.world_from_scan;
  for (std::size_t i = 0; i + 1 < poses.size(); i += 2) std::swap(poses[i], poses[i + 1]);
  return trajectory;
}

Trajectory identities(std::size_t num_poses) { return {.world_from_scan = std::vector<Pose>(num_poses)}; }

/// Trajectories that are wrong as a whole.
void judge_mistakes(const Scene& scene, const AdjustmentSettings& adjustment, RefusalSuite& suite) {
  const auto judge = [&](const char* name, const Trajectory& given) {
    suite.judge(fmt::format("{}, {}", scene.name, name), suite.sample(scene, given, adjustment), Due::kAnything);
  };
  judge("inverse poses", inverse_of(scene.true_poses));
  judge("poses shifted by one", shifted(scene.true_poses, 1));
  judge("poses shifted by three", shifted(scene.true_poses, 3));
  judge("neighbors exchanged", permuted(scene.true_poses));
  judge("identity poses", identities(scene.true_poses.size()));
}

/// Of every scan only the points at which `keeps(point in world)`.
template <class Keeps>
Scene part_of(const Scene& scene, const char* name, const Keeps& keeps) {
  Scene result{.name = scene.name + name, .true_poses = scene.true_poses};
  std::vector<Scan> parts;
  for (std::size_t i = 0; i < scene.scans.size(); ++i) {
    Scan part;
    for (const Eigen::Vector3d& point_in_scan : scene.scans.load(i).points_in_scan) {
      if (keeps(scene.true_poses.world_from_scan[i] * point_in_scan)) part.points_in_scan.push_back(point_in_scan);
    }
    parts.push_back(std::move(part));
  }
  result.scans = MemoryScans(std::move(parts));
  return result;
}

/// Two long walls and the ground between them: nothing says how far along a sensor is.
Scene corridor_scene(std::uint64_t seed) {
  SimulatedWorld world;
  const auto add = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& along, const Eigen::Vector3d& across) {
    auto& vertices = world.mesh.vertices_in_world;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Eigen::Vector3d& vertex : {corner, Eigen::Vector3d(corner + along),
                                          Eigen::Vector3d(corner + along + across), Eigen::Vector3d(corner + across)}) {
      vertices.push_back(vertex);
    }
    world.mesh.triangles.push_back({first, first + 1, first + 2});
    world.mesh.triangles.push_back({first, first + 2, first + 3});
  };
  const Eigen::Vector3d along(400, 0, 0);
  add({-200, -4, 0}, along, {0, 8, 0});
  add({-200, -4, 0}, along, {0, 0, 6});
  add({-200, 4, 0}, along, {0, 0, 6});
  world.route_in_world = {{-20, 0, 1.8}, {20, 0, 1.8}};
  const Trajectory poses = drive(world, {.num_scans = 10, .seed = seed});
  const SimulatedScans scans(world, poses, sensor_preset("carla32"), seed);
  return {.name = "corridor", .scans = in_memory(scans, 10), .true_poses = poses};
}

void judge_degenerate(const Scene& scene, const EstimateStudySettings& study, RefusalSuite& suite) {
  const auto judge = [&](const Scene& part, const char* name, const AdjustmentSettings& settings) {
    const EstimateSample sample = estimate_sample(part.scans, part.true_poses, disturb(part.true_poses, study, 0),
                                                  settings, suite.options.execution());
    suite.judge(part.name + name, sample, Due::kAnything);
  };
  judge(part_of(scene, ", ground only", [](const Eigen::Vector3d& point) { return point.z() < 0.15; }), "",
        study.adjustment);
  judge(scene.first(2), ", two scans", study.adjustment);
  AdjustmentSettings few = study.adjustment;
  few.max_patches_per_source = 8;
  judge(scene, ", 40 patches", few);
}

/// There is no truth, but the scans are known to agree nowhere to better than decimetres: any number is wrong.
void judge_depth_scans(RefusalSuite& suite) {
  const ScanFiles scans = open_scans(suite.options.depth + "/pcs");
  const Trajectory poses = read_trajectory(suite.options.depth + "/poses").trajectory;
  EstimateSample sample = estimate_sample(scans, poses, {.given = poses}, AdjustmentSettings::room_scale());
  sample.true_m = std::nan("");
  suite.judge("depth scans of a room", sample, Due::kRefusal);
}

void run_refusals(const Options& options) {
  RefusalSuite suite{.options = options};
  EstimateStudySettings study = options.study();
  study.least_factor = study.most_factor = 1;
  fmt::print("| case | true RPE [m] | answer | estimate [m] | bound [m] | |\n|---|--:|---|--:|--:|---|\n");
  for (std::size_t world = options.first_world; world < options.num_worlds; ++world) {
    const Scene scene = town_scene(world, 10, options.seed);
    judge_perturbations(scene, study.adjustment, suite);
    judge_mistakes(scene, study.adjustment, suite);
    judge_degenerate(scene, study, suite);
  }
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Scene scene = corridor_scene(options.seed + seed);
    suite.judge(fmt::format("corridor {}", seed),
                estimate_sample(scene.scans, scene.true_poses, disturb(scene.true_poses, study, 0), study.adjustment,
                                options.execution()),
                Due::kAnything);
  }
  if (!options.kitti.empty()) {
    study.adjustment.min_range_m = kRangeOfBody_m;
    const Scene scene = kitti_scene(options, 10);
    judge_perturbations(scene, study.adjustment, suite);
    judge_mistakes(scene, study.adjustment, suite);
    Trajectory camera = read_trajectory(options.kitti + "/poses.txt").trajectory;
    camera.world_from_scan.resize(10);
    suite.judge("KITTI 00, no calibration", suite.sample(scene, camera, study.adjustment), Due::kAnything);
  }
  if (!options.depth.empty()) judge_depth_scans(suite);
  fmt::print("\n{} cases: {} wrong acceptances; {} of the {} that should get a number are refused ({})\n",
             suite.num_cases, suite.num_wrong, suite.num_false_refusals, suite.num_due,
             percent(static_cast<double>(suite.num_false_refusals) / static_cast<double>(suite.num_due)));
  fmt::print("near pairs: {} wrong acceptances; {} of the refused cases have a number for some of them\n",
             suite.num_wrong_pairs, suite.num_rescued);
}

// ---- A sensor that hardly moves
// ---------------------------------------------------------------------------------------

std::optional<double> mme_of(const Scene& scene, const Trajectory& poses, const Options& options) {
  MapSettings map_settings;
  map_settings.max_range_m = 15;
  const AssembledMap map = assemble_map(scene.scans, poses, map_settings, options.execution());
  const PointIndex index(map.map, options.execution());
  const NeighborhoodSettings settings{.radius_m = 0.5};
  return mme(point_statistics(index, map.map.points_in_map, settings, Definition::kPaper, options.execution())).value;
}

void run_beams(const Options& options) {
  fmt::print(
      "| drive | MME true | MME identity | estimate of true poses [m] | of identity poses [m] | true RPE of these [m] "
      "|\n"
      "|---|--:|--:|--:|--:|--:|\n");
  for (std::size_t number_of_world = 0; number_of_world < options.num_worlds; ++number_of_world) {
    const SimulatedWorld world = make_world(kTowns.at(number_of_world % kTowns.size()), options.seed + number_of_world);
    const Trajectory poses = drive(world, {.num_scans = 10,
                                           .step_m = 0.01,
                                           .sway_m = 0,
                                           .heave_sigma_m = 0.01,
                                           .tilt_sigma_rad = 0.001,
                                           .seed = options.seed + number_of_world});
    const SimulatedScans scans(world, poses, sensor_preset("carla32"), options.seed + number_of_world);
    const Scene scene{.name = "", .scans = in_memory(scans, poses.size()), .true_poses = poses};
    const Trajectory identity = identities(poses.size());
    const auto text = [&](const Trajectory& given) {
      const EstimateSample sample =
          estimate_sample(scene.scans, poses, {.given = given}, options.study().adjustment, options.execution());
      return fmt::format("{} {}", number(sample.estimate_m, "{:.4f}"), name_of(sample.status));
    };
    fmt::print("| {} | {} | {} | {} | {} | {:.4f} |\n", number_of_world,
               number(mme_of(scene, poses, options), "{:.3f}"), number(mme_of(scene, identity, options), "{:.3f}"),
               text(poses), text(identity), all_pairs_rpe(poses, identity).translation_m.rmse);
    std::fflush(stdout);
  }
}

// ---- Poses of real drives -------------------------------------------------------------------------------------------

/// What KITTI's poses are worth, and whether the adjusted poses depend on where the adjustment starts.
void run_real(const Options& options) {
  AdjustmentSettings settings;
  settings.min_range_m = kRangeOfBody_m;
  for (const std::size_t num_scans : options.lengths_or({20})) {
    const Scene scene = kitti_as_it_is(options, num_scans);
    std::vector<Trajectory> adjusted;
    const auto judge = [&](const char* name, const Trajectory& given) {
      const auto begin = std::chrono::steady_clock::now();
      const RpeEstimate estimate = estimate_rpe(scene.scans, given, settings, options.execution());
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      fmt::print("{} scans, {}: {} {} m {} deg, interval {}, bound {}, halves {}, near and far {}; {:.1f} s\n",
                 num_scans, name, name_of(estimate.status), number(estimate.translation_rms_m, "{:.4f}"),
                 in_degrees(estimate.rotation_rms_rad), interval(estimate.interval_m, 1),
                 number(estimate.upper_bound_m, "{:.4f}"), number(estimate.half_difference_m, "{:.4f}"),
                 number(estimate.systematic_indicator_m, "{:.4f}"), seconds);
      std::fflush(stdout);
      if (estimate.adjusted.size() == num_scans) adjusted.push_back(estimate.adjusted);
    };
    judge("poses of GNSS and INS", scene.true_poses);
    if (options.other_poses.empty()) continue;
    Trajectory other = read_trajectory(options.other_poses).trajectory;
    other.world_from_scan.resize(num_scans);
    judge("other poses", other);
    if (adjusted.size() < 2) continue;
    const AllPairsRpe between = all_pairs_rpe(adjusted[0], adjusted[1]);
    fmt::print("{} scans, adjusted from either: they differ by {:.3f} mm, {:.5f} deg\n", num_scans,
               1000 * between.translation_m.rmse, between.rotation_rad.rmse / kRadiansPerDegree);
  }
}

// ---- Long drives ----------------------------------------------------------------------------------------------------

/// Of an RpeEstimate or a PairRpe.
template <class Estimate>
std::string range_of(const Estimate& estimate) {
  if (estimate.upper_bound_m) return fmt::format("at most {:.4f}", *estimate.upper_bound_m);
  if (!estimate.interval_m) return "–";
  return fmt::format("{:.4f}, {:.4f} to {:.4f}", *estimate.translation_rms_m, (*estimate.interval_m)[0],
                     (*estimate.interval_m)[1]);
}

void print_pairs(const RpeEstimate& estimate, const Trajectory& true_poses, const Trajectory& given) {
  for (const PairRpe& pairs : estimate.by_pairs) {
    if (pairs.num_pairs == 0) continue;
    fmt::print("|  | {:g} {} | {:.4f} | {} | {} | {} | | |\n", pairs.pairs.delta, name_of(pairs.pairs.unit),
               rpe(true_poses, given, {.pairs = pairs.pairs}).statistics.rmse, name_of(pairs.status), range_of(pairs),
               number(pairs.half_difference_m, "{:.4f}"));
  }
}

/// Drives of hundreds of poses: all pairs and near ones, time and memory.
void run_long(const Options& options) {
  fmt::print(
      "| drive | pairs | true RPE [m] | answer | estimate [m] | halves [m] | seconds | MB at most "
      "|\n|---|---|--:|---|---|--:|--:|--:|\n");
  EstimateStudySettings study = options.study();
  study.noise.model = NoiseModel::kWalk;
  for (std::size_t number_of_world = options.first_world; number_of_world < options.num_worlds; ++number_of_world) {
    const SimulatedWorld world = make_world(kTowns.at(number_of_world % kTowns.size()), options.seed + number_of_world);
    for (const std::size_t num_scans : options.lengths_or({300, 1000})) {
      const Trajectory poses = drive(world, {.num_scans = num_scans, .seed = options.seed + number_of_world});
      const SimulatedScans scans(world, poses, sensor_preset("carla32"), options.seed + number_of_world);
      const Trajectory given = disturb(poses, study, 0).given;
      const auto begin = std::chrono::steady_clock::now();
      const RpeEstimate estimate = estimate_rpe(scans, given, study.adjustment, options.execution());
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      fmt::print("| {}, {} scans | all | {:.4f} | {} | {} | {} | {:.0f} | {} |\n",
                 kNames.at(number_of_world % kTowns.size()), num_scans, all_pairs_rpe(poses, given).translation_m.rmse,
                 name_of(estimate.status), range_of(estimate), number(estimate.half_difference_m, "{:.4f}"), seconds,
                 bench::peak_resident_bytes() / 1'000'000);
      print_pairs(estimate, poses, given);
      for (const std::string& reason : estimate.reasons) fmt::print(stderr, "{}\n", reason);
      std::fflush(stdout);
    }
  }
}

void run(const Options& options) {
  if (options.set == "towns") return run_towns(options);
  if (options.set == "kitti") return run_kitti(options);
  if (options.set == "outliers") return run_outliers(options);
  if (options.set == "refusals") return run_refusals(options);
  if (options.set == "beams") return run_beams(options);
  if (options.set == "real") return run_real(options);
  run_long(options);
}

}  // namespace
}  // namespace trysquare

int main(int argc, char** argv) {
  CLI::App app("How good the estimate of the RPE without ground truth is");
  trysquare::Options options;
  app.add_option("SET", options.set, "What is measured")
      ->required()
      ->check(CLI::IsMember({"towns", "kitti", "outliers", "refusals", "beams", "real", "long"}));
  app.add_option("--kitti", options.kitti, "A KITTI sequence: velodyne/, poses.txt, calib.txt");
  app.add_option("--other-poses", options.other_poses, "Poses of the same scans from elsewhere, for real");
  app.add_option("--depth", options.depth, "Depth scans: pcs/ and poses/");
  app.add_option("--model", options.model, "white or walk")->check(CLI::IsMember({"white", "walk"}));
  app.add_option("--lengths", options.lengths, "Numbers of poses; each set has its own")->delimiter(',');
  app.add_option("--worlds", options.num_worlds, "Simulated worlds: streets, grids, suburbs, old towns in turn");
  app.add_option("--first-world", options.first_world, "Leave out those before");
  app.add_option("--trajectories", options.num_trajectories, "Of every scene and length");
  app.add_option("--patches", options.num_patches_per_source, "Of every scan that offers some");
  app.add_option("--translation", options.translation_m, "Noise per axis [m]");
  app.add_option("--rotation", options.rotation_deg, "Noise per axis [degrees]");
  app.add_option("--least", options.least_factor, "Of the noise: every trajectory draws its share");
  app.add_option("--most", options.most_factor, "Likewise");
  app.add_option("--samples", options.samples, "CSV file to which every estimate is appended at once");
  app.add_option("--outliers", options.outliers_m, "How far one pose is moved [m]")->delimiter(',');
  app.add_option("--seed", options.seed, "Of worlds and noise");
  app.add_option("--threads", options.num_threads, "0: all cores");
  CLI11_PARSE(app, argc, argv);
  try {
    trysquare::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
