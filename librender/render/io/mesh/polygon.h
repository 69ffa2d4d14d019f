#pragma once
/// Polygons cut into triangles.

#include <render/core/types.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// The n - 2 triangles of a polygon of n >= 3 corners, as places among its corners, wound as it is. Of any size,
/// concave or not, with corners in line, repeated ones, and slits that lead to holes. Seen along its mean normal
/// [Sutherland74] they lie side by side and cover it; where they all lie about corner 0, they do.
///   error  : the triangles' areas add up to the polygon's to within 1e-9 of it, unless it crosses itself
///   time   : n of triangles, of convex polygons and where corner 0 sees all of it; else n^2 as a rule, n^3 at worst
///   Source : ears are cut off [Eberly02]
std::vector<std::array<std::uint32_t, 3>> triangulate_polygon(std::span<const Vec3d> corners);

/// The same of a polygon of `positions`, put behind the triangles that are there.
void append_triangulated(const std::vector<Vec3d>& positions, std::span<const std::uint32_t> polygon,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace render
