#pragma once
/// The claimed density where every chart has points.

#include <mc/check/subject/subject.h>

#include <optional>
#include <span>

namespace mc {

/// The claimed density at v. On the faces of the cube charts of infinite domains have no point: there v is moved
/// inside, by 2^-500 at 0 and by 2^-53 at 1. A v that is nearer to the face at 0 than that, but not on it, stays where
/// it is if the density is finite and positive there. Where the density is infinite at v alone, it is that beside v.
double interior_density(const Subject& subject, const Subject::Coordinates& v);
/// Those at many points, which it moves likewise: one question where the subject answers many at once.
void interior_densities(const Subject& subject, std::span<Subject::Coordinates> v, std::span<double> densities);

/// The density beside v, where it is 0 or not finite at v but not beside it: a set of measure zero, which says nothing
/// against a sampler whose points are rounded onto it. Beside a face of the cube is as near as the domain tells points
/// apart: 2^-500, 2^-52 or 2^-30; inside, where the density jumps to 0 or is infinite, min_resolved_steps.
std::optional<double> adjacent_density(const Subject& subject, const Subject::Coordinates& v);

} // namespace mc
