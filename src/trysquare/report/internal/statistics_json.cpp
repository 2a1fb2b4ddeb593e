// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/statistics_json.h"

namespace trysquare::internal {

void set_statistics(Json& json, const ErrorStatistics& statistics) {
  json["rmse"] = statistics.rmse;
  json["mean"] = statistics.mean;
  json["median"] = statistics.median;
  json["std"] = statistics.std;
  json["min"] = statistics.min;
  json["max"] = statistics.max;
  json["sse"] = statistics.sse;
}

ErrorStatistics in_degrees(const ErrorStatistics& statistics_in_rad) {
  ErrorStatistics degrees = statistics_in_rad;
  for (double* value : {&degrees.rmse, &degrees.mean, &degrees.median, &degrees.std, &degrees.min, &degrees.max}) {
    *value *= kDegreesPerRadian;
  }
  degrees.sse *= kDegreesPerRadian * kDegreesPerRadian;
  return degrees;
}

}  // namespace trysquare::internal
