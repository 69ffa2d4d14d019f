#pragma once
/// Correct subjects of random kind, shape and size, for error_rates_bench.cpp and error_rates_test.cpp. Equal seeds
/// give equal subjects.

#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>

#include <array>
#include <cmath>
#include <vector>

namespace checker_bench {

using mc::Pcg, mc::Subject;

inline double uniform(Pcg& r) { return r.uniform<double>(); }
/// Returns a random number between lo and hi, uniform in the logarithm.
inline double log_uniform(Pcg& r, double lo, double hi) { return lo * std::pow(hi / lo, uniform(r)); }
inline double uniform_between(Pcg& r, double lo, double hi) { return lo + (hi - lo) * uniform(r); }
inline int random_index(Pcg& r, int n) { return static_cast<int>(r.next32() % static_cast<std::uint32_t>(n)); }

/// Returns a random subject: any of the kinds below, or a warp of libmc on its domain, in float or double.
Subject random_correct(std::uint64_t seed);
/// Returns a random subject with axes.
Subject random_continuous(std::uint64_t seed);
/// Returns a narrow feature on a uniform background, which random points easily miss: a ring, a spot, a ridge or a skew
/// tube.
Subject random_narrow(std::uint64_t seed);
/// Returns a subject that rounding makes difficult: a beta distribution with poles, a Dirichlet distribution on the
/// triangle, a lobe of any width by a formula that cancels, in float or double, or up to 1e7 uniform outcomes.
Subject random_rounded(std::uint64_t seed);

/// A table of random size and texture, with or without its breaks.
Subject table_1d(Pcg& r);
/// A table in two dimensions of random size and texture, with or without its breaks.
Subject table_2d(Pcg& r);
/// A narrow lobe on a uniform sphere.
Subject lobe_on_sphere(Pcg& r);
/// A heavy tail on a half line.
Subject heavy_tail(Pcg& r);
/// Powers of x, y and z in a box, some of them singular.
Subject powers_in_box(Pcg& r);
/// Uniform in a strip, a disk or a checkerboard.
Subject set_in_box(Pcg& r);
/// Uniform in a ball in a box.
Subject ball_in_box(Pcg& r);
/// A mixture of a broad and a narrow normal on the line.
Subject normals(Pcg& r);
/// A table in x times a power of y, sheared on a torus.
Subject product(Pcg& r);
/// A mixture of products of powers, a mixture of boxes or a ball, in a box of four to six dimensions.
Subject many_dimensions(Pcg& r);
/// Rotations near a random one, by a power of the cosine of half the angle.
Subject rotations(Pcg& r);
/// Discrete outcomes, up to 1e6.
Subject outcomes(Pcg& r);

/// Returns the subject of a table, with or without its breaks.
Subject table_subject(const std::string& name, const std::vector<double>& weights, std::size_t width,
                      std::size_t height, bool named);
Subject table_subject(const std::string& name, const std::vector<double>& weights, bool named);
/// Returns a mixture of a uniform sphere and a share k of von Mises-Fisher about `pole`.
Subject lobe_on_sphere(double k, double kappa, const mc::Vec3<double>& pole);
/// Returns the uniform distribution on the part of the unit square where `inside` is true; `area` is its area.
Subject uniform_inside(std::string name, double area, const std::function<bool(const mc::Vec2<double>&)>& inside);
Subject uniform_ball_in_box(double radius);
/// Returns the density of a beta distribution with samples of another one; equal parameters are correct.
Subject beta_subject(double a, double b, double sampled_a, double sampled_b);
/// Returns the density of a Dirichlet distribution on the triangle (x, y, 1 - x - y) with samples of another one.
Subject dirichlet_subject(const std::array<double, 3>& a, const std::array<double, 3>& sampled);
/// Returns a lobe about +z of about this width of 1 - cos theta: Henyey-Greenstein by the usual formula, or von
/// Mises-Fisher by [Wood94].
Subject narrow_lobe(bool in_float, bool of_wood, double width);
/// Returns n outcomes of probability 1/n.
Subject uniform_outcomes(std::size_t n);

} // namespace checker_bench
