#pragma once
/// Projections of points of many dimensions onto every pair of axes.

#include <mc/points/point_list.h>

#include <string>

namespace carlo {

/// Returns an SVG picture with a square for each pair of axes. In the first square axis 0 points to the right and axis
/// 1 upwards. The picture shows at most 8 axes. Requires at least two dimensions.
std::string projections_svg(mc::PointList points);

} // namespace carlo
