#pragma once
/// Quality parameter of digital nets.

#include <mc/points/point_list.h>

#include <cstdint>
#include <optional>

namespace mc {

/// Returns the least t for which 2^m points are a (t,m,s)-net in base 2: each elementary box of volume 2^(t-m) contains
/// exactly 2^t points.
///   nullopt : if the number of points is no power of two, or if the decision would take more than `work` visits of a
///             point.
///   Source  : [Niederreiter92].
std::optional<int> net_quality(PointList points, std::uint64_t work = 1'000'000'000);

} // namespace mc
