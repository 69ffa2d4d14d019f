#pragma once
/// The complementary error function and its inverse, compiled once: Boost.Math stays out of the headers of warps.

namespace mc {

/// 2 / sqrt(pi) times the integral of exp(-t^2) from x to infinity. Relative error 4 eps.
///   Source : Boost.Math
float erfc(float x);
double erfc(double x);

/// The x with erfc(x) = p, for p in (0, 2). Relative error 4 eps.
///   Source : Boost.Math
float erfc_inv(float p);
double erfc_inv(double p);

} // namespace mc
