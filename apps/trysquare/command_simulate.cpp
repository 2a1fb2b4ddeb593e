// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/kitti_sequence_writer.h"
#include "trysquare/io/read_mesh.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/report/simulation_json.h"
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/simulated_scans.h"
#include "trysquare/synthetic/plane_world.h"

#include "commands.h"
#include "common_options.h"
#include "input_options.h"
#include "interruption.h"
#include "outputs.h"
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare simulate town OUT --style suburb --scans 200 --sensor hdl64 --moving-cars
  trysquare simulate mesh OUT --mesh building.obj --poses path.tum --beams 16 --fov -15 15 --azimuths 900
OUT gets velodyne/*.bin, the true poses.txt (frame of the sensor), times.txt and calib.txt (identity), whole or not at all.
The same options and seed give the same bytes. Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input.)";

constexpr double kRadians = std::numbers::pi / 180;
constexpr std::array<const char*, 6> kWorlds = {"planes", "street", "town", "room", "office", "mesh"};

struct SimulateOptions {
  CommonOptions common;
  std::string world;
  std::string folder;
  std::size_t num_scans = 30;
  std::optional<double> step_m;
  std::optional<std::string> style;
  std::optional<std::string> mesh;
  std::optional<std::string> poses;
  std::string poses_format = "auto";
  bool moving_cars = false;
  bool force = false;
  std::optional<double> look_left_deg;
  std::optional<double> look_down_deg;

  std::optional<std::string> sensor;
  std::optional<int> num_beams;
  std::optional<int> num_azimuths;
  std::vector<double> elevations_deg;
  std::optional<double> horizontal_fov_deg;
  std::optional<double> min_range_m;
  std::optional<double> max_range_m;
  std::optional<double> range_sigma_m;
  std::optional<double> dropout;
  bool rolling_shutter = false;

  std::size_t num_discs_per_direction = 9;
  std::optional<std::size_t> points_per_disc;

  bool is_indoors() const { return world == "room" || world == "office"; }
  bool has_sensor_option() const {
    return sensor || num_beams || num_azimuths || !elevations_deg.empty() || horizontal_fov_deg || min_range_m ||
           max_range_m || dropout || rolling_shutter;
  }
  double step() const { return step_m.value_or(is_indoors() ? 0.1 : 1.0); }
};

/// Options that the chosen world has no use for are mistakes.
void refuse_misplaced_options(const SimulateOptions& options) {
  const bool on_streets = options.world == "street" || options.world == "town";
  const auto refuse = [&](bool is_given, const char* option, const char* worlds) {
    if (is_given) throw InvalidArgument(fmt::format("{} is for {}, not for {}", option, worlds, options.world));
  };
  refuse(options.style && options.world != "town", "--style", "town");
  refuse(options.mesh && options.world != "mesh", "--mesh", "mesh");
  refuse(options.moving_cars && !on_streets, "--moving-cars", "street and town");
  refuse(options.points_per_disc && options.world != "planes", "--points-per-disc", "planes");
  refuse(options.has_sensor_option() && options.world == "planes", "a sensor (but --noise)",
         "worlds with surfaces that hide each other");
  if (options.poses && options.step_m) throw InvalidArgument("--step is given, but --poses says where the scans are");
  if (options.world != "mesh") return;
  if (!options.mesh) throw InvalidArgument("simulate mesh needs --mesh FILE, an OBJ or PLY file");
  if (!options.poses) throw InvalidArgument("a mesh has no route: simulate mesh needs --poses FILE");
}

void require_free_folder(const SimulateOptions& options) {
  std::error_code ignored;
  const std::filesystem::path folder = options.folder;
  if (options.force || !std::filesystem::is_directory(folder, ignored) || std::filesystem::is_empty(folder, ignored)) {
    return;
  }
  throw InvalidArgument(
      fmt::format("{}: the folder exists and is not empty: give --force to replace its velodyne, "
                  "poses.txt, times.txt and calib.txt",
                  options.folder));
}

SensorModel sensor_of(const SimulateOptions& options) {
  SensorModel sensor = sensor_preset(options.sensor.value_or(options.is_indoors() ? "depth-camera" : "carla32"));
  sensor.num_beams = options.num_beams.value_or(sensor.num_beams);
  sensor.num_azimuths = options.num_azimuths.value_or(sensor.num_azimuths);
  if (!options.elevations_deg.empty()) {
    sensor.lowest_elevation_rad = options.elevations_deg.at(0) * kRadians;
    sensor.highest_elevation_rad = options.elevations_deg.at(1) * kRadians;
  }
  if (options.horizontal_fov_deg) sensor.horizontal_fov_rad = *options.horizontal_fov_deg * kRadians;
  sensor.min_range_m = options.min_range_m.value_or(sensor.min_range_m);
  sensor.max_range_m = options.max_range_m.value_or(sensor.max_range_m);
  sensor.range_sigma_m = options.range_sigma_m.value_or(sensor.range_sigma_m);
  sensor.dropout = options.dropout.value_or(sensor.dropout);
  sensor.rolling_shutter = options.rolling_shutter;
  sensor.validate();
  return sensor;
}

WorldStyle style_of(const SimulateOptions& options) {
  const std::string style = options.style.value_or("grid");
  if (options.world == "street") return WorldStyle::kStreet;
  if (options.world == "room") return WorldStyle::kRoom;
  if (options.world == "office") return WorldStyle::kOffice;
  if (style == "suburb") return WorldStyle::kTownSuburb;
  return style == "oldtown" ? WorldStyle::kTownOld : WorldStyle::kTownGrid;
}

SimulatedWorld world_of(const SimulateOptions& options) {
  constexpr int kCarsInStreet = 3;
  constexpr int kCarsInTown = 24;
  if (options.mesh) return {.mesh = read_mesh(*options.mesh)};
  WorldSettings settings;
  const double needed_m = 1.1 * options.step() * static_cast<double>(options.num_scans);
  settings.street_length_m = std::max(settings.street_length_m, needed_m);
  if (options.moving_cars) settings.num_moving_cars = options.world == "town" ? kCarsInTown : kCarsInStreet;
  return make_world(style_of(options), options.common.seed, settings);
}

/// Along the route of the world; in rooms the camera looks a little down and to the side where the furniture is.
Trajectory driven(const SimulatedWorld& world, const SimulateOptions& options, double period_s) {
  const bool indoors = options.is_indoors();
  return drive(world, {.num_scans = options.num_scans,
                       .step_m = options.step(),
                       .period_s = period_s,
                       .look_left_rad = options.look_left_deg.value_or(indoors ? 30 : 0) * kRadians,
                       .look_down_rad = options.look_down_deg.value_or(indoors ? 15 : 0) * kRadians,
                       .seed = options.common.seed});
}

Trajectory poses_of(const SimulateOptions& options) {
  const TrajectoryFile file = read_trajectory(*options.poses, format_option(options.poses_format));
  options.common.warn(file.warnings);
  return file.trajectory;
}

/// The scans that are to be written, with their true poses, and what is to be said of them.
struct Simulation {
  std::unique_ptr<ScanSequence> scans;
  Trajectory true_poses;
  SimulationFacts facts;
};

Simulation simulate_planes(const SimulateOptions& options) {
  constexpr double kSpacing_m = 3.2;  // farther than neighborhoods and discs reach
  PlaneWorldSettings settings{.seed = options.common.seed};
  settings.point_sigma_m = options.range_sigma_m.value_or(settings.point_sigma_m);
  settings.points_per_disc = options.points_per_disc.value_or(settings.points_per_disc);
  const std::vector<Disc> discs = orthogonal_discs(options.num_discs_per_direction, kSpacing_m, options.common.seed);
  const double way_m = 1.1 * options.step() * static_cast<double>(options.num_scans) + 1;
  const SimulatedWorld line{.mesh = {}, .route_in_world = {{0, 0, 0}, {way_m, 0, 0}}};
  Trajectory poses = options.poses ? poses_of(options) : driven(line, options, 0.1);
  auto scans = std::make_unique<MemoryScans>(observe_discs(discs, poses, settings));
  SimulationFacts facts{.planes = SimulatedPlanesFacts{.num_discs = discs.size(),
                                                       .points_per_disc = settings.points_per_disc,
                                                       .disc_radius_m = settings.disc_radius_m,
                                                       .point_sigma_m = settings.point_sigma_m}};
  return {std::move(scans), std::move(poses), std::move(facts)};
}

SimulatedSensorFacts facts_of(const SensorModel& sensor, const SimulateOptions& options) {
  return {.name = options.sensor.value_or(options.is_indoors() ? "depth-camera" : "carla32"),
          .num_beams = sensor.num_beams,
          .num_azimuths = sensor.num_azimuths,
          .lowest_elevation_rad = sensor.lowest_elevation_rad,
          .highest_elevation_rad = sensor.highest_elevation_rad,
          .horizontal_fov_rad = sensor.horizontal_fov_rad,
          .min_range_m = sensor.min_range_m,
          .max_range_m = sensor.max_range_m,
          .range_sigma_m = sensor.range_sigma_m,
          .dropout = sensor.dropout,
          .rolling_shutter = sensor.rolling_shutter};
}

Simulation simulate_sensor(const SimulateOptions& options) {
  const SensorModel sensor = sensor_of(options);
  const SimulatedWorld world = world_of(options);
  Trajectory poses = options.poses ? poses_of(options) : driven(world, options, sensor.period_s);
  auto scans = std::make_unique<SimulatedScans>(world, poses, sensor, options.common.seed);
  SimulationFacts facts{.num_moving_cars = world.moving.size(),
                        .num_triangles = world.mesh.triangles.size(),
                        .sensor = facts_of(sensor, options)};
  return {std::move(scans), std::move(poses), std::move(facts)};
}

/// Writes the data set; the number of points of each scan.
std::vector<std::size_t> write(const Simulation& simulation, const SimulateOptions& options) {
  const Interruption interruption;
  KittiSequenceWriter writer(options.folder, options.force);
  std::vector<std::size_t> num_points(simulation.scans->size());
  for_each_block(num_points.size(), 1, options.common.execution(), "scans", [&](const Block& block) {
    interruption.check();
    const Scan scan = simulation.scans->load(block.index);
    num_points[block.index] = scan.points_in_scan.size();
    writer.write_scan(block.index, scan.points_in_scan);
  });
  writer.finish(simulation.true_poses);
  return num_points;
}

double path_length_m(const Trajectory& poses) {
  double length_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length_m += (poses.world_from_scan[i].translation - poses.world_from_scan[i - 1].translation).norm();
  }
  return length_m;
}

SimulationFacts complete(SimulationFacts facts, const SimulateOptions& options, const Trajectory& poses,
                         const std::vector<std::size_t>& num_points) {
  facts.version = TRYSQUARE_VERSION;
  facts.world = options.world;
  if (options.world == "town") facts.style = options.style.value_or("grid");
  facts.mesh = options.mesh;
  facts.poses = options.poses;
  if (!options.poses) facts.step_m = options.step();
  facts.seed = options.common.seed;
  facts.num_scans = num_points.size();
  facts.num_points = std::accumulate(num_points.begin(), num_points.end(), std::uint64_t{0});
  const auto [fewest, most] = std::minmax_element(num_points.begin(), num_points.end());
  facts.num_points_min = *fewest;
  facts.num_points_max = *most;
  facts.path_length_m = path_length_m(poses);
  return facts;
}

void warn_of_empty_scans(const SimulateOptions& options, const std::vector<std::size_t>& num_points) {
  const auto num_empty = std::count(num_points.begin(), num_points.end(), std::size_t{0});
  if (num_empty == 0) return;
  options.common.warn({{"empty_scans", fmt::format("{} of {} scans have no points: nothing is within the range of the "
                                                   "sensor there",
                                                   num_empty, num_points.size())}});
}

void run(const SimulateOptions& options) {
  refuse_misplaced_options(options);
  require_free_folder(options);
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  options.common.execution().validate();
  const Simulation simulation = options.world == "planes" ? simulate_planes(options) : simulate_sensor(options);
  const std::vector<std::size_t> num_points = write(simulation, options);
  const SimulationFacts facts = complete(simulation.facts, options, simulation.true_poses, num_points);
  warn_of_empty_scans(options, num_points);
  if (options.common.prints_tables()) {
    fmt::print("{} scans, {} points ({} to {} a scan), {:.1f} m of way\n", facts.num_scans, facts.num_points,
               facts.num_points_min, facts.num_points_max, facts.path_length_m);
  }
  write_json(options.common.json, to_json(facts));
}

void add_world_options(CLI::App& verb, SimulateOptions& options) {
  const std::string group = "World";
  verb.add_option("--scans", options.num_scans, "Number of scans; with --poses as many as there are poses")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->group(group);
  verb.add_option("--step", options.step_m, "Way from scan to scan [m], about; default: 1, in rooms 0.1")->group(group);
  verb.add_option("--style", options.style, "Of a town; default: grid")
      ->check(CLI::IsMember({"grid", "suburb", "oldtown"}))
      ->group(group);
  verb.add_flag("--moving-cars", options.moving_cars, "Cars that come the other way")->group(group);
  verb.add_option("--mesh", options.mesh, "OBJ or PLY file with the surfaces of `mesh`")->group(group);
  verb.add_option("--poses", options.poses, "Poses of the sensor in the world, instead of the route of the world")
      ->group(group);
  verb.add_option("--poses-format", options.poses_format, "Of that file")
      ->check(CLI::IsMember({"auto", "kitti", "tum", "euroc", "matrix"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--points-per-disc", options.points_per_disc, "In every scan of `planes`; default: 300")
      ->group(group);
}

void add_sensor_options(CLI::App& verb, SimulateOptions& options) {
  const std::string group = "Sensor";
  verb.add_option("--sensor", options.sensor,
                  "carla32, hdl64, os1-128 or depth-camera; default: carla32, in rooms depth-camera")
      ->group(group);
  verb.add_option("--beams", options.num_beams, "Rows, instead of those of --sensor, like all of these")->group(group);
  verb.add_option("--fov", options.elevations_deg, "Lowest and highest elevation [degrees]")->expected(2)->group(group);
  verb.add_option("--azimuths", options.num_azimuths, "Columns")->group(group);
  verb.add_option("--horizontal-fov", options.horizontal_fov_deg, "Width of the view [degrees]; 360: all around")
      ->group(group);
  verb.add_option("--min-range", options.min_range_m, "Nearer returns are lost [m]")->group(group);
  verb.add_option("--max-range", options.max_range_m, "Farther returns are lost [m]")->group(group);
  verb.add_option("--noise", options.range_sigma_m, "Standard deviation along the ray [m]; of `planes` across them")
      ->group(group);
  verb.add_option("--dropout", options.dropout, "Share of returns that are lost, 0 to 1")->group(group);
  verb.add_flag("--rolling-shutter", options.rolling_shutter, "Columns one after the other while the sensor moves on")
      ->group(group);
  verb.add_option("--look-left", options.look_left_deg, "Turn the sensor away from the way ahead [degrees]")
      ->group(group);
  verb.add_option("--look-down", options.look_down_deg, "Tilt the sensor forward [degrees]; in rooms 15")->group(group);
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App& verb = *app.add_subcommand("simulate", "A data set with scans and true poses, in KITTI's layout");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("WORLD", options->world, "planes, street, town, room, office or mesh")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(kWorlds.begin(), kWorlds.end())));
  verb.add_option("OUT", options->folder, "Folder to write; must be empty or missing")->required();
  verb.add_flag("--force", options->force, "Replace the data set that is in OUT");
  add_world_options(verb, *options);
  add_sensor_options(verb, *options);
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
