#pragma once
/// Radial power spectrum of point sets.

#include <mc/points/point_list.h>

#include <vector>

namespace mc {

/// Power |sum_i exp(-2 pi i f x_i)|^2 / n of the first two coordinates at integer frequencies f, averaged over rings k
/// - 1/2 <= |f| < k + 1/2. Entry k - 1 is the mean of ring k, for k = 1 to `rings`.
///   random : 1 everywhere for independent points. The variance of the mean of an integrand is the sum of its power
///            times this spectrum, divided by n.
///   needs  : At least two dimensions.
///   cost   : 2 rings^2 n complex products.
///   Source : [PilleboueEtAl15].
std::vector<double> radial_power_spectrum(PointList points, int rings);

/// Expected radial spectrum of jittered points: 1 - sinc^2(f_x / m) sinc^2(f_y / m). The points lie in the cells of a
/// grid of at least two dimensions with m cells along each axis.
std::vector<double> jittered_radial_spectrum(double m, int rings);

} // namespace mc
