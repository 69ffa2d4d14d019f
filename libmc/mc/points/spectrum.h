#pragma once
/// The power spectrum of points: how they see waves.

#include <mc/points/point_list.h>

#include <vector>

namespace mc {

/// The power |sum_i exp(-2 pi i f x_i)|^2 / n of the first two coordinates at whole frequencies f, averaged over the
/// rings k - 1/2 <= |f| < k + 1/2: entry k - 1 is that of ring k, for k = 1 to `rings`. Independent points have 1
/// everywhere, the variance of an integrand's mean is the sum of its power times this, over n.
///   needs  : two dimensions or more
///   cost   : 2 rings^2 n complex products
///   Source : [PilleboueEtAl15]
std::vector<double> radial_power_spectrum(PointList points, int rings);

/// The same in expectation for jittered points, one in each cell of a grid of two or more dimensions with m cells along
/// an axis: 1 - sinc^2(f_x / m) sinc^2(f_y / m).
std::vector<double> jittered_radial_spectrum(double m, int rings);

} // namespace mc
