// SPDX-License-Identifier: Apache-2.0
// cluster_normals for tests/oracle/normal_clusters.py: trysquare_cluster_normals LINKAGE SIGNS CUT < NORMALS > LABELS
// LINKAGE: complete | ward. SIGNS: sign-free | signed. Normals are N × 3 doubles, labels N unsigned 32-bit integers.
#include "trysquare/metrics/normal_clusters.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace {

std::vector<Eigen::Vector3d> read_normals(std::istream& in) {
  std::vector<Eigen::Vector3d> normals;
  Eigen::Vector3d normal;
  while (in.read(reinterpret_cast<char*>(normal.data()), sizeof(normal))) normals.push_back(normal);
  return normals;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 3) return 2;
  try {
    const trysquare::NormalClusterSettings settings{
        .linkage = arguments[0] == "ward" ? trysquare::Linkage::kWard : trysquare::Linkage::kComplete,
        .cut = std::stod(arguments[2]),
        .sign_free = arguments[1] == "sign-free"};
    const std::vector<std::uint32_t> labels = trysquare::cluster_normals(read_normals(std::cin), settings);
    std::cout.write(reinterpret_cast<const char*>(labels.data()),
                    static_cast<std::streamsize>(labels.size() * sizeof(labels[0])));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return std::cout.flush() ? 0 : 1;
}
