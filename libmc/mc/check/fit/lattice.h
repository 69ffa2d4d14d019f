#pragma once
/// Lattices on which samples lie because intermediate results are rounded.

#include <mc/check/fit/pilot.h>

namespace mc {

/// Widest step of a lattice that rounding explains: 16 machine epsilons of intermediate results of order 1, or random
/// numbers of 31 bits.
inline double widest_lattice_step(double epsilon) { return std::max(16 * epsilon, 0x1p-31); }

/// Returns the step of the lattice of the pilot's coordinates near 0 on an axis, where floating-point numbers are much
/// denser than rounded intermediate results; 0 without a lattice. The number of equal pairs, compared with the number
/// of samples nearby, gives the step.
double lattice_step(const Subject& subject, const Pilot& pilot, std::size_t axis);

/// Returns the subject with resolutions of at least the steps of its lattices, as far as rounding explains them. Tests
/// then do not resolve the lattice.
Subject with_lattices(const Subject& subject, const Pilot& pilot);

} // namespace mc
