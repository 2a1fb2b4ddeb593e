// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/test_readers.h"

#include "trysquare/core/error.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/internal/test_files.h"
#include "trysquare/io/parse_trajectory.h"
#include "trysquare/io/read_mesh.h"
#include "trysquare/io/read_points.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>

namespace {

std::atomic<std::size_t> largest_allocation = 0;

void* allocate(std::size_t size) {
  if (size > largest_allocation) largest_allocation = size;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace trysquare::internal {
namespace {

std::function<void(std::string_view)> points(PointFormat format) {
  return [format](std::string_view bytes) { parse_points(bytes, format, "f", Columns::kAll); };
}

std::function<void(std::string_view)> poses(TrajectoryFormat format) {
  return [format](std::string_view text) { parse_trajectory(text, "f", format); };
}

}  // namespace

std::vector<ReaderUnderTest> readers_under_test() {
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z _ i\nSIZE 4 4 4 1 2\nTYPE F F F U U\nCOUNT 1 1 1 2 2\nWIDTH 3\nHEIGHT 1\nPOINTS "
      "3\nDATA ";
  const std::string planes(3 * 18, 'p');
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty double z\nproperty uchar c\n";
  const std::string mesh = vertices + "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string lists =
      "element face 2\nproperty list uchar int i\nelement vertex 2\nproperty float x\n"
      "property list ushort short w\nproperty float y\nproperty float z\n";
  const std::string lists_body =
      "\x01"
      "item" +
      std::string(1, '\0') + bytes_of(1.0F) + bytes_of(std::uint16_t{2}) + "wwww" + bytes_of_all<float>({2, 3, 4}) +
      std::string(2, '\0') + bytes_of_all<float>({5, 6});
  const auto ply = [](const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\ncomment c\n" + elements + "end_header\n";
  };
  const std::string numbers = "1 0 0 1.5 0 1 0 -2e-3 0 0 1 3";
  return {
      {"kitti_bin", bytes_of_all<float>({1, 2, 3, 4, 5, 6, 7, 8}), points(PointFormat::kKittiBin)},
      {"nuscenes_bin", bytes_of_all<float>({1, 2, 3, 4, 5}), points(PointFormat::kNuScenesBin)},
      {"pcd_ascii", pcd + "ascii\n1 2 3 0 0 4 5\n-1.5 2e1 nan 0 0 4 5\n1 2 3 0 0 4 5\n", points(PointFormat::kPcd)},
      {"pcd_binary", pcd + "binary\n" + planes, points(PointFormat::kPcd)},
      {"pcd_compressed", pcd + "binary_compressed\n" + compressed_body(lzf_literals(planes), planes.size()),
       points(PointFormat::kPcd)},
      {"ply_ascii", ply("ascii", vertices) + "1 2 3 4\n5 6 7 8\n9 1 2 3\n", points(PointFormat::kPly)},
      {"ply_ascii_lists", ply("ascii", lists) + "1 9\n0\n1 2 7 7 2 3\n4 0 5 6\n", points(PointFormat::kPly)},
      {"ply_little", ply("binary_little_endian", vertices) + std::string(51, 'v'), points(PointFormat::kPly)},
      {"ply_big", ply("binary_big_endian", vertices) + std::string(51, 'v'), points(PointFormat::kPly)},
      {"ply_lists", ply("binary_little_endian", lists) + lists_body, points(PointFormat::kPly)},
      {"xyz", "# t x y z\nx,y,z,t\n1,2,3,4\n5,6,7,8 // end\n", points(PointFormat::kXyz)},
      {"pts", "2\n1 2 3 4\n5 6 7 8\n", points(PointFormat::kXyz)},
      {"npy", npy_header("'<f8'", "(2, 3)") + bytes_of_all<double>({1, 2, 3, 4, 5, 6}), points(PointFormat::kNpy)},
      {"npy2", npy_header("'>f4'", "(2, 4)", true, 2) + bytes_of_all<float>({1, 2, 3, 4, 5, 6, 7, 8}),
       points(PointFormat::kNpy)},
      {"tum", "# t\n1.5 1 2 3 0 0 0 1\n2.5e0 1.25 2 3 0 0.6 0 0.8\n", poses(TrajectoryFormat::kTum)},
      {"kitti", numbers + "\n" + numbers + "\n", poses(TrajectoryFormat::kKitti)},
      {"euroc", "#t\n1403715524907143168,1,2,3,1,0,0,0,9\n1403715524907143169,1,2,3,1,0,0,0,9\n",
       poses(TrajectoryFormat::kEuroc)},
      {"matrices", "1 0 0 1.5\n0 1 0 2\n0 0 1 3\n0 0 0 1\n" + numbers + " 0 0 0 1\n",
       poses(TrajectoryFormat::kMatrices)},
      {"carla_csv", "# frame,timestamp,x,y,z,roll,pitch,yaw\n7,0.5,1,2.25,3,10,20,-30\n9,0.6,1,2,3,1e1,2,3\n",
       poses(TrajectoryFormat::kCarla)},
      {"carla_matrices",
       "frame m00 m01 m02 m03 m10 m11 m12 m13 m20 m21 m22 m23 m30 m31 m32 m33\n7 " + numbers + " 0 0 0 1\n",
       poses(TrajectoryFormat::kCarla)},
      {"carla_json",
       R"([{"frame": 7, "x": 1, "y": 2, "z": 3, "roll": 1, "pitch": 2, "yaw": 3}, {"frame": 8, "transform": )"
       R"({"location": {"x": 1, "y": 2, "z": 3}, "rotation": {"pitch": 4, "yaw": 5, "roll": 6}}}])",
       poses(TrajectoryFormat::kCarla)},
      {"carla_frames", R"({"7": {"matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]], "timestamp": 0.05}})",
       poses(TrajectoryFormat::kCarla)},
      {"nclt", "1326030975726043, nan, 0, 0, 0, 0, 0\n1326030975726043, 1, 2.25, 3, 0.1, -2, 3\n",
       poses(TrajectoryFormat::kNclt)},
      {"mulran", "1561000444390857630,1,0,0,1,0,1,0,2.25,0,0,1,3\n", poses(TrajectoryFormat::kMulran)},
      {"newer_college", "#sec,nsec\n1583836591,182590976,1,2.25,3,0,0.6,0,0.8\n",
       poses(TrajectoryFormat::kNewerCollege)},
      {"g2o", "FIX 0\nVERTEX_SE3:QUAT 7 1 2.25 3 0 0.6 0 0.8\nEDGE_SE3:QUAT 7 2 0 0\n", poses(TrajectoryFormat::kG2o)},
      {"balm", "0,-1,0,1,\n1,0,0,2.25,\n0,0,1,3,\n0,0,0,1583836591.25,\n", poses(TrajectoryFormat::kBalm)},
      {"calibration", "P0: 1 2 3\nTr: " + numbers + "\n",
       [](std::string_view text) { parse_kitti_calibration(text, "f"); }},
      {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1/2 2//3 3/1/1\nf -1 -2 -3\n",
       [](std::string_view text) { parse_obj(text, "f"); }},
      {"ply_mesh_ascii", ply("ascii", mesh) + "1 2 3 4\n5 6 7 8\n9 1 2 3\n3 0 1 2\n",
       [](std::string_view bytes) { parse_ply_mesh(bytes, "f"); }},
      {"ply_mesh_binary", ply("binary_big_endian", mesh) + std::string(51, '\0') + "\3" + std::string(12, '\0'),
       [](std::string_view bytes) { parse_ply_mesh(bytes, "f"); }},
  };
}

bool read_or_refuse(const ReaderUnderTest& reader, std::string_view bytes) {
  // LZF unpacks to 88 times its size, a byte becomes a double; 1 MiB holds the names of as many columns as there may
  // be.
  const std::size_t most = (1U << 20) + bytes.size() * 88 * sizeof(double);
  bool is_read = false;
  const std::size_t largest = largest_allocation_of([&] {
    try {
      reader.read(bytes);
      is_read = true;
    } catch (const IoError& error) {
      if (std::string_view(error.what()).rfind("f: ", 0) != 0) {
        throw std::runtime_error(std::string("the message does not begin with the file: ") + error.what());
      }
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("not an IoError: ") + error.what());
    }
  });
  if (largest > most) {
    throw std::runtime_error("asks for " + std::to_string(largest) + " bytes of memory at once, of a file of " +
                             std::to_string(bytes.size()));
  }
  return is_read;
}

std::size_t largest_allocation_of(const std::function<void()>& run) {
  largest_allocation = 0;
  run();
  return largest_allocation;
}

std::string mutated(std::string bytes, std::mt19937& random) {
  constexpr std::string_view kSpice = "0123456789-+.eE \n\r\t,;#/nanif\"'(){}[]:\xFF\x80\x7F";
  const auto below = [&](std::size_t bound) { return random() % bound; };
  for (std::size_t left = 1 + below(4); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = kSpice[below(kSpice.size())];
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, 1 + below(12), kSpice[below(kSpice.size())]);  // digits in a row make huge claims
        break;
      default:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(24)));
        break;
    }
  }
  return bytes;
}

}  // namespace trysquare::internal
