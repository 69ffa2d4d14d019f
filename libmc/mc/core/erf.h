#pragma once
/// The complementary error function and its inverse. Compiled in one source file, so that headers need no Boost.Math.

namespace mc {

/// Complementary error function: 2 / sqrt(pi) times the integral of exp(-t^2) from x to infinity.
///   error  : relative error at most 4 eps.
///   Source : Boost.Math.
float erfc(float x);
/// Same for double.
double erfc(double x);

/// Inverse of erfc(): the x with erfc(x) = p, for p in (0, 2).
///   error  : relative error at most 4 eps.
///   Source : Boost.Math.
float erfc_inv(float p);
/// Same for double.
double erfc_inv(double p);

} // namespace mc
