#include <sampling/theory.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace carlo {

namespace {

using Class = Smoothness::Class;

// Arguments: the dimension d and, for a corner, the exponent a of its singularity.
using RateLaw = ConvergenceRate (*)(double d, double a);

struct RateRow {
  Class kind;
  RateLaw law;
};

// Exponents for surfaces that the cells of a stratification only enclose.
double jump(double d) { return 0.5 + 0.5 / d; }
double kink(double d) { return 0.5 + 1.5 / d; }

ConvergenceRate random_law(double, double) { return {0.5, 0, "variance sigma^2 / N"}; }

ConvergenceRate jittered(double d, double) { return {0.5 + 1 / d, 0, "[Haber66]; [MitchellA96]"}; }
ConvergenceRate jittered_jump(double d, double) { return {jump(d), 0, "[MitchellA96]"}; }
// The cells at the singularity dominate for a > -1/2. At a = -1/2 all cells contribute equally and add the root of a
// logarithm. Below, x^-a behaves like a smooth function.
ConvergenceRate jittered_corner(double d, double a) {
  return {0.5 + std::min(1.0, 0.5 - a) / d, 0, "cells at the singular faces",
          a == -0.5 ? RateBound::at_most : RateBound::exact};
}

constexpr std::string_view owen = "[Owen97]", discontinuous = "[HeWang15]; [He18]", surface = "cells at the surface",
                           order_one = "[KuoSchwabSloan12]", unbounded = "[Owen06]; [Liu24]";

ConvergenceRate net(double d, double) { return {1.5, (d - 1) / 2, owen}; }
ConvergenceRate net_additive(double, double) { return {1.5, 0, owen}; }
ConvergenceRate net_kink(double d, double) { return {std::min(1.5, kink(d)), 0, surface}; }
ConvergenceRate net_axis_jump(double d, double) { return {1, (d - 1) / 2, discontinuous}; }
ConvergenceRate net_jump(double d, double) { return {jump(d), 0, discontinuous}; }
// Logarithms come from terms in several variables, which are small compared with terms in one variable.
ConvergenceRate net_corner(double d, double a) {
  return {std::min(1.5, 1 - a), 0, unbounded, d > 1 || a == -0.5 ? RateBound::at_most : RateBound::exact};
}

ConvergenceRate first_order(double, double) { return {1, 0, order_one, RateBound::at_most}; }
ConvergenceRate first_order_kink(double d, double) { return {std::min(1.0, kink(d)), 0, surface, RateBound::at_most}; }
ConvergenceRate first_order_corner(double, double a) {
  return {std::min(1.0, 1 - a), 0, unbounded, RateBound::at_most};
}
ConvergenceRate lattice_periodic(double, double) { return {1, 0, "[Niederreiter92] chapter 5", RateBound::at_least}; }
// Kinks where the faces meet make the Fourier coefficients of frequency k fall as k^-2. For a sum of functions of one
// coordinate each, the error of a lattice of N points consists of every N-th coefficient.
ConvergenceRate lattice_closed(double, double) { return {2, 0, "Fourier coefficients k^-2", RateBound::at_most}; }
ConvergenceRate lattice_closed_additive(double, double) { return {2, 0, "Fourier coefficients k^-2"}; }
ConvergenceRate halton_smooth(double, double) { return {1, 0, "[OwenPan23]", RateBound::at_most}; }

ConvergenceRate latin_law(double, double) { return {0.5, 0, "[Stein87]; [Owen98]"}; }
ConvergenceRate latin_additive(double, double) { return {1.5, 0, "[Stein87]; [Owen98]"}; }

// An error of N^-3/4 in addition to the jittered error. For an integrand with a singular end, x = 1/n replaces the end.
constexpr std::string_view correlated = "[Kensler13]: one of n strata of an axis moves at once";
ConvergenceRate correlated_smooth(double, double) { return {0.75, 0, correlated}; }
ConvergenceRate correlated_corner(double, double a) { return {0.75 - a / 2, 0, correlated}; }

ConvergenceRate interlaced(double, double) { return {2.5, 0, "[Dick11]"}; }
ConvergenceRate interlaced_kink(double d, double) { return {std::min(2.5, kink(d)), 0, surface}; }
ConvergenceRate interlaced_axis_kink(double, double) { return {kink(1), 0, surface, RateBound::at_most}; }

constexpr std::string_view unknown = "none known as the density is learned; a bound by [OwenZhou00] and [PanOwen23]";
ConvergenceRate learned(double, double) { return {0.5, 0, unknown, RateBound::at_least}; }

constexpr std::array random_rows = {RateRow{Class::smooth, random_law},    RateRow{Class::additive, random_law},
                                    RateRow{Class::periodic, random_law},  RateRow{Class::kink, random_law},
                                    RateRow{Class::axis_kink, random_law}, RateRow{Class::axis_jump, random_law},
                                    RateRow{Class::jump, random_law},      RateRow{Class::corner, random_law}};
constexpr std::array jittered_rows = {RateRow{Class::smooth, jittered},    RateRow{Class::additive, jittered},
                                      RateRow{Class::periodic, jittered},  RateRow{Class::kink, jittered},
                                      RateRow{Class::axis_kink, jittered}, RateRow{Class::axis_jump, jittered_jump},
                                      RateRow{Class::jump, jittered_jump}, RateRow{Class::corner, jittered_corner}};
constexpr std::array net_rows = {RateRow{Class::smooth, net},    RateRow{Class::additive, net_additive},
                                 RateRow{Class::periodic, net},  RateRow{Class::kink, net_kink},
                                 RateRow{Class::axis_kink, net}, RateRow{Class::axis_jump, net_axis_jump},
                                 RateRow{Class::jump, net_jump}, RateRow{Class::corner, net_corner}};
constexpr std::array latin_rows = {RateRow{Class::smooth, latin_law},    RateRow{Class::additive, latin_additive},
                                   RateRow{Class::periodic, latin_law},  RateRow{Class::kink, latin_law},
                                   RateRow{Class::axis_kink, latin_law}, RateRow{Class::axis_jump, latin_law},
                                   RateRow{Class::jump, latin_law},      RateRow{Class::corner, latin_law}};
constexpr std::array correlated_rows = {
    RateRow{Class::smooth, correlated_smooth},    RateRow{Class::additive, latin_additive},
    RateRow{Class::periodic, latin_additive},     RateRow{Class::kink, correlated_smooth},
    RateRow{Class::axis_kink, correlated_smooth}, RateRow{Class::axis_jump, correlated_smooth},
    RateRow{Class::jump, correlated_smooth},      RateRow{Class::corner, correlated_corner}};
constexpr std::array halton_rows = {
    RateRow{Class::smooth, halton_smooth},    RateRow{Class::additive, halton_smooth},
    RateRow{Class::periodic, halton_smooth},  RateRow{Class::kink, first_order_kink},
    RateRow{Class::axis_kink, halton_smooth}, RateRow{Class::axis_jump, halton_smooth},
    RateRow{Class::jump, net_jump},           RateRow{Class::corner, first_order_corner}};
constexpr std::array lattice_rows = {RateRow{Class::smooth, first_order},
                                     RateRow{Class::additive, first_order},
                                     RateRow{Class::periodic, lattice_periodic},
                                     RateRow{Class::kink, first_order_kink},
                                     RateRow{Class::axis_kink, first_order},
                                     RateRow{Class::axis_jump, first_order},
                                     RateRow{Class::jump, net_jump},
                                     RateRow{Class::corner, first_order_corner}};
constexpr std::array closed_lattice_rows = {RateRow{Class::smooth, lattice_closed},
                                            RateRow{Class::additive, lattice_closed_additive},
                                            RateRow{Class::axis_kink, lattice_closed}};
constexpr std::array interlaced_rows = {RateRow{Class::smooth, interlaced},
                                        RateRow{Class::additive, interlaced},
                                        RateRow{Class::periodic, interlaced},
                                        RateRow{Class::kink, interlaced_kink},
                                        RateRow{Class::axis_kink, interlaced_axis_kink},
                                        RateRow{Class::axis_jump, net_axis_jump},
                                        RateRow{Class::jump, net_jump},
                                        RateRow{Class::corner, net_corner}};
constexpr std::array learned_rows = {RateRow{Class::smooth, learned},    RateRow{Class::additive, learned},
                                     RateRow{Class::periodic, learned},  RateRow{Class::kink, learned},
                                     RateRow{Class::axis_kink, learned}, RateRow{Class::axis_jump, learned},
                                     RateRow{Class::jump, learned},      RateRow{Class::corner, learned}};

// The rows that hold for a sampler in d dimensions. Padded sets of fewer dimensions integrate the part that is not
// additive over the sets as a Latin hypercube does [Owen98].
std::span<const RateRow> rows_of(std::string_view method, int d, bool matching_faces) {
  if (method == "random") return random_rows;
  if (method == "stratified") return jittered_rows;
  // The sizes of its rounds tend to constant shares of N. Its grids have at most eight dimensions.
  if (method == "stratified_rounds" && d <= 8) return jittered_rows;
  if (method == "sobol") return net_rows;
  if (method == "halton")
    return d == 1 ? std::span<const RateRow>(net_rows) : halton_rows; // base two is a net in base two
  if (method == "lattice") return matching_faces ? std::span<const RateRow>(closed_lattice_rows) : lattice_rows;
  if (method == "latin_hypercube") return d == 1 ? std::span<const RateRow>(jittered_rows) : latin_rows;
  if (method == "padded_sobol") return d <= 2 ? std::span<const RateRow>(net_rows) : latin_rows;
  if (method == "padded_sobol_4d") return d <= 4 ? std::span<const RateRow>(net_rows) : latin_rows;
  if (method == "multi_jittered") {
    if (d == 1) return jittered_rows;
    return d == 2 ? std::span<const RateRow>(correlated_rows) : latin_rows;
  }
  if (method == "rqmc") return d <= 2 ? std::span<const RateRow>(interlaced_rows) : net_rows;
  if (method == "vegas" || method == "tree" || method == "auto") return learned_rows;
  return {};
}

} // namespace

double ConvergenceRate::local_exponent(double n) const { return exponent - log_power / std::log(n); }

bool ConvergenceRate::is_consistent_with(double lo, double hi, double n) const {
  const double slope = -local_exponent(n);
  return (bound == RateBound::at_most || lo <= slope) && (bound == RateBound::at_least || slope <= hi);
}

std::string ConvergenceRate::to_string(int digits) const {
  static constexpr std::array words = {"", "no steeper than ", "at least as steep as "};
  return fmt::format("{}{:.{}f}", words[static_cast<std::size_t>(bound)], -exponent, digits);
}

std::optional<ConvergenceRate> theoretical_rate(std::string_view method, const Smoothness& smoothness, int dim) {
  if (smoothness.kind == Class::corner && !(smoothness.corner_exponent < 0.5)) return {};
  for (const RateRow& row : rows_of(method, dim, smoothness.matching_faces))
    if (row.kind == smoothness.kind) return row.law(dim, smoothness.corner_exponent);
  return {};
}

} // namespace carlo
