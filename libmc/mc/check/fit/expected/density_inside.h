#pragma once
/// The claimed density where every chart has points.

#include <mc/check/subject/subject.h>

#include <optional>
#include <span>

namespace mc {

/// The claimed density at v, moved off the faces of the cube by 2^-500 at 0 and by 2^-53 at 1, where charts of infinite
/// domains have no point, or less where it is finite there, and beside v where it is infinite there alone.
double density_inside(const Subject& subject, const Subject::Coordinates& v);
/// Those at many points, which it moves likewise: one question where the subject answers many at once.
void densities_inside(const Subject& subject, std::span<Subject::Coordinates> v, std::span<double> densities);

/// The density beside v, where it is 0 or not finite at v but not beside it: a set of measure zero, which says nothing
/// against a sampler whose points are rounded onto it. Beside a face of the cube is as near as the domain tells points
/// apart: 2^-500, 2^-52 or 2^-30; inside, where the density jumps to 0 or is infinite, rounded_steps.
std::optional<double> density_beside(const Subject& subject, const Subject::Coordinates& v);

} // namespace mc
