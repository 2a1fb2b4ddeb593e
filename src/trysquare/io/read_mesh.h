// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/triangle_mesh.h"

#include <filesystem>
#include <string_view>

namespace trysquare {

/// The surfaces of a Wavefront OBJ file: the lines `v x y z` and `f` (a polygon of three corners or more: 7, 7/1, 7//2,
/// 7/1/2, or -1 for the last vertex before it); everything else is skipped. Polygons are cut into triangles that share
/// their first corner, which is right for convex ones.
/// @param name      what messages call the text: the path, usually.
/// @throws IoError  naming the line; or if there is no triangle.
TriangleMesh parse_obj(std::string_view text, std::string_view name);

/// The surfaces of a PLY 1.0 file, ascii and binary of both byte orders: x, y, z of the element `vertex` and the list
/// `vertex_indices` (or `vertex_index`) of the element `face`, cut into triangles as above; everything else is skipped.
/// @throws IoError  naming the line or the byte; or if there is no triangle. No memory is taken for what a header only
///                  claims.
TriangleMesh parse_ply_mesh(std::string_view bytes, std::string_view name);

/// Reads .obj or .ply.
/// @throws IoError  if the file is missing, of no known format, or malformed.
TriangleMesh read_mesh(const std::filesystem::path& path);

}  // namespace trysquare
