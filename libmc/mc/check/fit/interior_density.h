#pragma once
/// The claimed density in the interior of the chart.

#include <mc/check/subject/subject.h>

#include <optional>
#include <span>

namespace mc {

/// Returns the claimed density at v. Charts of infinite domains have no point on some faces of the cube, so v on a face
/// moves inside: by 2^-500 at 0 and by 2^-53 at 1. A v with a coordinate in (0, 2^-500) stays if the density there is
/// finite and positive. If the density is infinite at v alone, the density next to v is returned.
double interior_density(const Subject& subject, const Subject::Coordinates& v);
/// The same at many points, which it moves in the same way. Uses one batch if the subject evaluates batches.
void interior_densities(const Subject& subject, std::span<Subject::Coordinates> v, std::span<double> densities);

/// Returns the density next to v if it is positive and finite there, but 0 or not finite at v; else no value. Such a v
/// belongs to a set of measure zero, and samples may be rounded onto it without a fault. The distance is the smallest
/// that the domain resolves: 2^-500, 2^-52 or 2^-30 from a face of the cube. In the interior, where the density jumps
/// to 0 or is infinite, it is at most min_resolved_steps.
std::optional<double> adjacent_density(const Subject& subject, const Subject::Coordinates& v);

} // namespace mc
