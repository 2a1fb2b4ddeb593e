// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_mesh.h"

#include "trysquare/io/internal/test_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trysquare {
namespace {

using internal::bytes_of;
using internal::bytes_of_all;
using internal::io_error_of;
using testing::ElementsAre;
using testing::HasSubstr;

using Triangle = std::array<std::uint32_t, 3>;

const std::vector<Eigen::Vector3d> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
const std::string kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n";

std::string obj_error(const std::string& text) {
  return io_error_of([&] { parse_obj(text, "a.obj"); });
}
std::string ply_error(const std::string& bytes) {
  return io_error_of([&] { parse_ply_mesh(bytes, "a.ply"); });
}

std::string ply(const std::string& format, const std::string& elements, const std::string& body) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

const std::string kElements =
    "element vertex 4\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\n"
    "element face 1\nproperty uchar flags\nproperty list uchar int vertex_indices\n";
const std::string kText = "0 0 9 0\n1 0 9 0\n1 1 9 0.5\n0 1 9 0\n7 4 0 1 2 3\n";

std::string square_body(std::endian order) {
  std::string body;
  for (const Eigen::Vector3d& p : kSquare) {
    body += bytes_of_all<float>({p.x(), p.y()}, order) + "\x09" + bytes_of(p.z(), order);
  }
  return body + "\x07\x04" + bytes_of_all<std::int32_t>({0, 1, 2, 3}, order);
}

TEST(ParseObj, CutsPolygonsIntoTrianglesThatShareTheirFirstCorner) {
  const TriangleMesh mesh = parse_obj(kObjSquare + "f 2 3 4 1\n", "a.obj");
  EXPECT_EQ(mesh.vertices_in_world, kSquare);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
}

TEST(ParseObj, KnowsEveryWayToNameACorner) {
  const TriangleMesh mesh = parse_obj(kObjSquare + "f 1/7 2/8/9 3//4\nf -1 -2/1 -4//2 # from the end\r\n", "a.obj");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{3, 2, 0}));
}

TEST(ParseObj, CountsBackFromTheVerticesThatWereThereByThen) {
  EXPECT_THAT(parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nv 9 9 9\n", "a.obj").triangles,
              ElementsAre(Triangle{2, 1, 0}));
}

TEST(ParseObj, SkipsWhatIsNoSurfaceAndKeepsForwardReferences) {
  const TriangleMesh mesh = parse_obj(
      "# c\nmtllib a.mtl\no thing\nvn 0 0 1\nvt 0 0\ns off\nusemtl m\nf 1 2 3\nv 0 0 0 1.0\nv 1 0 0 0.1 0.2 0.3\nv 0 1 "
      "0\nl 1 2\n",
      "a.obj");
  EXPECT_EQ(mesh.vertices_in_world.size(), 3U);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(ParseObj, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(obj_error("v 0 0\n"), HasSubstr("a.obj: line 1: "));
  EXPECT_THAT(obj_error("v 0 0 nan\n"), HasSubstr("a.obj: line 1: found a vertex"));
  EXPECT_THAT(obj_error("v 0 x 0\n"), HasSubstr("\"x\""));
  EXPECT_THAT(obj_error(kObjSquare + "f 1 2\n"), HasSubstr("a.obj: line 5: found a polygon of 2 corners"));
  EXPECT_THAT(obj_error(kObjSquare + "f 1 2 0\n"), HasSubstr("a.obj: line 5: found \"0\""));
  EXPECT_THAT(obj_error(kObjSquare + "f 1 2 a\n"), HasSubstr("a.obj: line 5: found \"a\""));
  EXPECT_THAT(obj_error(kObjSquare + "f 1 2 -5\n"), HasSubstr("a.obj: line 5: "));
  EXPECT_THAT(obj_error(kObjSquare + "\nf 1 2 5\nf 1 2 3\n"), HasSubstr("a.obj: line 6: "));
  EXPECT_THAT(obj_error(kObjSquare + "f 1 2 99999999999999\n"), HasSubstr("a.obj: line 5: "));
}

TEST(ParseObj, RefusesAFileWithoutTriangles) {
  EXPECT_THAT(obj_error(""), HasSubstr("a.obj: the file has no triangle in it"));
  EXPECT_THAT(obj_error(kObjSquare), HasSubstr("no triangle"));
}

TEST(ParsePlyMesh, ReadsTextAndBothByteOrders) {
  for (const std::string& bytes :
       {ply("ascii", kElements, kText), ply("binary_little_endian", kElements, square_body(std::endian::little)),
        ply("binary_big_endian", kElements, square_body(std::endian::big))}) {
    const TriangleMesh mesh = parse_ply_mesh(bytes, "a.ply");
    EXPECT_EQ(mesh.vertices_in_world, kSquare);
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  }
}

TEST(ParsePlyMesh, ReadsFacesBeforeVerticesAndTheOtherName) {
  const std::string elements =
      "element face 1\nproperty list uchar ushort vertex_index\nelement edge 1\nproperty list uchar int a\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const TriangleMesh mesh = parse_ply_mesh(ply("ascii", elements, "3 2 1 0\n0\n0 0 0\n1 0 0\n0 1 0\n"), "a.ply");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 1, 0}));
}

TEST(ParsePlyMesh, NamesThePlaceOfWhatIsWrong) {
  EXPECT_THAT(ply_error(""), HasSubstr("a.ply: byte 0"));
  EXPECT_THAT(ply_error(ply("ascii", kElements, "0 0 9 0\n1 0 9\n")), HasSubstr("a.ply: line 13: found 3 values"));
  EXPECT_THAT(ply_error(ply("ascii", kElements, "0 0 9 0\n1 0 9 0 8\n")), HasSubstr("a.ply: line 13: found 5 values"));
  EXPECT_THAT(ply_error(ply("ascii", kElements, "0 0 9 0\n")), HasSubstr("the file ends early"));
  EXPECT_THAT(ply_error(ply("ascii", kElements, "0 0 9 inf\n")), HasSubstr("a.ply: line 12: found a vertex"));
  const std::string faces = "0 0 9 0\n1 0 9 0\n1 1 9 0.5\n0 1 9 0\n";
  EXPECT_THAT(ply_error(ply("ascii", kElements, faces + "7 3 0 1 4\n")), HasSubstr("a.ply: line 16: "));
  EXPECT_THAT(ply_error(ply("ascii", kElements, faces + "7 3 0 1 -1\n")), HasSubstr("a.ply: line 16: "));
  EXPECT_THAT(ply_error(ply("ascii", kElements, faces + "7 2 0 1\n")), HasSubstr("polygon of 2 corners"));
  EXPECT_THAT(ply_error(ply("ascii", kElements, faces + "7 1.5 0 1\n")), HasSubstr("list of 1.5 items"));
  const std::string body = square_body(std::endian::little);
  EXPECT_THAT(ply_error(ply("binary_little_endian", kElements, body.substr(0, body.size() - 1))),
              HasSubstr("the file ends early"));
}

TEST(ParsePlyMesh, RefusesPointCloudsAndFacesWithoutCorners) {
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(ply_error(ply("ascii", vertex, "1 2 3\n")), HasSubstr("a.ply: the file has no triangle in it"));
  EXPECT_THAT(ply_error(ply("ascii", vertex + "element face 1\nproperty int a\n", "1 2 3\n1\n")),
              HasSubstr("a.ply: line 7: element face has no list vertex_indices"));
  EXPECT_THAT(ply_error(ply("ascii", "element vertex 1\nproperty float x\n", "1\n")), HasSubstr("no property y"));
}

TEST(ReadMesh, GoesByTheEndingOfTheName) {
  const internal::TemporaryFolder folder;
  EXPECT_EQ(read_mesh(folder.add("a.OBJ", kObjSquare + "f 1 2 3 4\n")).triangles.size(), 2U);
  EXPECT_EQ(read_mesh(folder.add("a.ply", ply("ascii", kElements, kText))).triangles.size(), 2U);
  EXPECT_THAT(io_error_of([&] { read_mesh(folder.add("a.stl", "")); }), HasSubstr(".obj or .ply"));
  EXPECT_THAT(io_error_of([&] { read_mesh(folder.path() / "missing.obj"); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace trysquare
