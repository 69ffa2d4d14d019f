#pragma once
/// Points of many dimensions, seen along every pair of axes.

#include <mc/points/point_list.h>

#include <string>

namespace carlo {

/// An SVG picture with a square for each pair of axes, axis 0 to the right and 1 upward in the first. At most 8 axes
/// are shown.
///   needs : two dimensions or more
std::string projections_svg(mc::PointList points);

} // namespace carlo
