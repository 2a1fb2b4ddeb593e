// SPDX-License-Identifier: Apache-2.0
// One call into each of the three libraries: a cloud is written and read back (io), judged, and reported (report).
#include "trysquare/io/read_points.h"
#include "trysquare/io/write_ply.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/neighborhood/point_index.h"
#include "trysquare/pipeline/evaluation.h"
#include "trysquare/report/evaluation_json.h"

#include <cstdio>
#include <filesystem>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path file = std::filesystem::path(argv[1]) / "box.ply";

  trysquare::PointTable box;
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.01, 0.01}) box.points.emplace_back(x, y, z);
    }
  }
  trysquare::write_ply(file, box);
  const trysquare::Scan map = trysquare::read_map(file);

  const trysquare::PointIndex index(map.points_in_scan);
  const trysquare::MetricResult mpv =
      trysquare::mpv(trysquare::point_statistics(index, map.points_in_scan, {.radius_m = 1.0, .min_neighbors = 6}));
  std::printf("mpv_m2 %.12f\n", mpv.value.value_or(-1));

  trysquare::Evaluation evaluation;
  evaluation.mpv = mpv;
  std::printf("json_bytes %zu\n", trysquare::to_json(evaluation, {}).size());
  return 0;
}
