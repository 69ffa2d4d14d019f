#pragma once
/// Whether points are a digital net, and how good a one.

#include <mc/points/point_list.h>

#include <cstdint>
#include <optional>

namespace mc {

/// The least t for which 2^m points are a (t,m,s)-net in base 2: each of the boxes of volume 2^(t-m) that come of
/// halving the cube holds exactly 2^t of them. Nothing when the number of points is no power of two, or when to decide
/// would take more than `work` points looked at.
///   Source : [Niederreiter92]
std::optional<int> net_quality(PointList points, std::uint64_t work = 1'000'000'000);

} // namespace mc
