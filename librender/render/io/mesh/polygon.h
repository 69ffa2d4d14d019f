#pragma once
/// Triangulation of polygons.

#include <render/core/types.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// Splits a polygon of n >= 3 corners into n - 2 triangles of corner indices, with the winding of the polygon. The
/// polygon may be concave and may have collinear or repeated corners, or slits that lead to holes. Projected along its
/// mean normal [Sutherland74], the triangles do not overlap and cover the polygon. If the fan about corner 0 has these
/// properties, it is returned.
///   error  : the areas of the triangles add up to the area of the polygon within 1e-9 of it, unless the polygon
///            intersects itself.
///   time   : O(n) for triangles, convex polygons, and polygons entirely visible from corner 0. Else usually O(n^2),
///            O(n^3) at worst.
///   Source : ear clipping [Eberly02].
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const Vec3d> corners);

/// Triangulates a polygon of `positions` and appends its triangles to `triangles`.
void append_triangulated(const std::vector<Vec3d>& positions, std::span<const std::uint32_t> polygon,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace render
