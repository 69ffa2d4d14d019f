#pragma once
/// Right samplers of random kind, shape and size: what error_rates_bench.cpp and error_rates_test.cpp try the checker on. Same
/// seed, same subject.

#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>

#include <cmath>
#include <vector>

namespace checker_bench {

using mc::Pcg, mc::Subject;

inline double uniform(Pcg& r) { return r.uniform<double>(); }
/// Between lo and hi, uniform in the logarithm.
inline double log_uniform(Pcg& r, double lo, double hi) { return lo * std::pow(hi / lo, uniform(r)); }
inline double uniform_between(Pcg& r, double lo, double hi) { return lo + (hi - lo) * uniform(r); }
inline int random_index(Pcg& r, int n) { return static_cast<int>(r.next32() % static_cast<std::uint32_t>(n)); }

/// Any of the kinds below, and warps of libmc on their domains, in float or double.
Subject random_correct(std::uint64_t seed);
/// One with axes.
Subject random_continuous(std::uint64_t seed);
/// Narrow features on an even ground, which random points easily miss: a ring, a spot, a ridge or a skew tube.
Subject random_narrow(std::uint64_t seed);

/// Tables of random size and texture, one in two naming its breaks; a narrow lobe in a uniform sphere; heavy tails;
/// singular powers in a box; uniform inside a strip, a disk or on a checkerboard; uniform in a ball in a box; broad and
/// narrow normals on the line; a table beside a power, turned about the axes of a torus; discrete outcomes, up to 1e6.
Subject table_1d(Pcg& r);
Subject table_2d(Pcg& r);
Subject lobe_on_sphere(Pcg& r);
Subject heavy_tail(Pcg& r);
Subject powers_in_box(Pcg& r);
Subject set_in_box(Pcg& r);
Subject ball_in_box(Pcg& r);
Subject normals(Pcg& r);
Subject product(Pcg& r);
Subject outcomes(Pcg& r);

/// The sampler of a table, with the breaks that it names or without.
Subject table_subject(const std::string& name, const std::vector<double>& weights, std::size_t width,
                      std::size_t height, bool named);
Subject table_subject(const std::string& name, const std::vector<double>& weights, bool named);
/// A share k of von Mises-Fisher about `pole` in a uniform sphere.
Subject lobe_on_sphere(double k, double kappa, const mc::Vec3<double>& pole);
/// Uniform where `inside` says, a part of the unit square of that area.
Subject uniform_inside(std::string name, double area, const std::function<bool(const mc::Vec2<double>&)>& inside);
Subject uniform_ball_in_box(double radius);

} // namespace checker_bench
