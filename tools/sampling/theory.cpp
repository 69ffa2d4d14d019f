#include <sampling/theory.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace carlo {

namespace {

using Class = Smoothness::Class;

// Of d dimensions and, for a corner, the exponent a of its singularity.
using Law = Rate (*)(double d, double a);

struct Row {
  Class of;
  Law law;
};

// Surfaces that the cells of a stratification only enclose.
double jump(double d) { return 0.5 + 0.5 / d; }
double kink(double d) { return 0.5 + 1.5 / d; }

Rate random_law(double, double) { return {0.5, 0, "variance sigma^2 / N"}; }

Rate jittered(double d, double) { return {0.5 + 1 / d, 0, "[Haber66]; [MitchellA96]"}; }
Rate jittered_jump(double d, double) { return {jump(d), 0, "[MitchellA96]"}; }
// Down to a = -1/2, where all cells count alike, by a root of a logarithm: below, x^-a is as good as smooth.
Rate jittered_corner(double d, double a) {
  return {0.5 + std::min(1.0, 0.5 - a) / d, 0, "cells at the singular faces",
          a == -0.5 ? Bound::at_most : Bound::exact};
}

constexpr std::string_view owen = "[Owen97]", discontinuous = "[HeWang15]; [He18]", surface = "cells at the surface",
                           order_one = "[KuoSchwabSloan12]", unbounded = "[Owen06]; [Liu24]";

Rate net(double d, double) { return {1.5, (d - 1) / 2, owen}; }
Rate net_additive(double, double) { return {1.5, 0, owen}; }
Rate net_kink(double d, double) { return {std::min(1.5, kink(d)), 0, surface}; }
Rate net_axis_jump(double d, double) { return {1, (d - 1) / 2, discontinuous}; }
Rate net_jump(double d, double) { return {jump(d), 0, discontinuous}; }
// Logarithms of the parts of many variables, which are small beside those of one.
Rate net_corner(double d, double a) {
  return {std::min(1.5, 1 - a), 0, unbounded, d > 1 || a == -0.5 ? Bound::at_most : Bound::exact};
}

Rate first_order(double, double) { return {1, 0, order_one, Bound::at_most}; }
Rate first_order_kink(double d, double) { return {std::min(1.0, kink(d)), 0, surface, Bound::at_most}; }
Rate first_order_corner(double, double a) { return {std::min(1.0, 1 - a), 0, unbounded, Bound::at_most}; }
Rate lattice_periodic(double, double) { return {1, 0, "[Niederreiter92] chapter 5", Bound::at_least}; }
// Bends where the faces meet: the coefficients of frequency k fall as k^-2, and of a sum of functions of one coordinate
// each a lattice of N points meets every N-th.
Rate lattice_closed(double, double) { return {2, 0, "Fourier coefficients k^-2", Bound::at_most}; }
Rate lattice_closed_additive(double, double) { return {2, 0, "Fourier coefficients k^-2"}; }
Rate halton_smooth(double, double) { return {1, 0, "[OwenPan23]", Bound::at_most}; }

Rate latin_law(double, double) { return {0.5, 0, "[Stein87]; [Owen98]"}; }
Rate latin_additive(double, double) { return {1.5, 0, "[Stein87]; [Owen98]"}; }

// An error of N^-3/4 on top of what is jittered. Of an integrand with an end at infinity x = 1/n stands for it.
constexpr std::string_view correlated = "[Kensler13]: one of n strata of an axis moves at once";
Rate correlated_smooth(double, double) { return {0.75, 0, correlated}; }
Rate correlated_corner(double, double a) { return {0.75 - a / 2, 0, correlated}; }

Rate interlaced(double, double) { return {2.5, 0, "[Dick11]"}; }
Rate interlaced_kink(double d, double) { return {std::min(2.5, kink(d)), 0, surface}; }
Rate interlaced_axis_kink(double, double) { return {kink(1), 0, surface, Bound::at_most}; }

constexpr std::string_view unknown = "none known as the density is learned; a bound by [OwenZhou00] and [PanOwen23]";
Rate learned(double, double) { return {0.5, 0, unknown, Bound::at_least}; }

constexpr std::array random_rows = {Row{Class::smooth, random_law},    Row{Class::additive, random_law},
                                    Row{Class::periodic, random_law},  Row{Class::kink, random_law},
                                    Row{Class::axis_kink, random_law}, Row{Class::axis_jump, random_law},
                                    Row{Class::jump, random_law},      Row{Class::corner, random_law}};
constexpr std::array jittered_rows = {Row{Class::smooth, jittered},    Row{Class::additive, jittered},
                                      Row{Class::periodic, jittered},  Row{Class::kink, jittered},
                                      Row{Class::axis_kink, jittered}, Row{Class::axis_jump, jittered_jump},
                                      Row{Class::jump, jittered_jump}, Row{Class::corner, jittered_corner}};
constexpr std::array net_rows = {Row{Class::smooth, net},    Row{Class::additive, net_additive},
                                 Row{Class::periodic, net},  Row{Class::kink, net_kink},
                                 Row{Class::axis_kink, net}, Row{Class::axis_jump, net_axis_jump},
                                 Row{Class::jump, net_jump}, Row{Class::corner, net_corner}};
constexpr std::array latin_rows = {Row{Class::smooth, latin_law},    Row{Class::additive, latin_additive},
                                   Row{Class::periodic, latin_law},  Row{Class::kink, latin_law},
                                   Row{Class::axis_kink, latin_law}, Row{Class::axis_jump, latin_law},
                                   Row{Class::jump, latin_law},      Row{Class::corner, latin_law}};
constexpr std::array correlated_rows = {
    Row{Class::smooth, correlated_smooth},    Row{Class::additive, latin_additive},
    Row{Class::periodic, latin_additive},     Row{Class::kink, correlated_smooth},
    Row{Class::axis_kink, correlated_smooth}, Row{Class::axis_jump, correlated_smooth},
    Row{Class::jump, correlated_smooth},      Row{Class::corner, correlated_corner}};
constexpr std::array halton_rows = {Row{Class::smooth, halton_smooth},    Row{Class::additive, halton_smooth},
                                    Row{Class::periodic, halton_smooth},  Row{Class::kink, first_order_kink},
                                    Row{Class::axis_kink, halton_smooth}, Row{Class::axis_jump, halton_smooth},
                                    Row{Class::jump, net_jump},           Row{Class::corner, first_order_corner}};
constexpr std::array lattice_rows = {
    Row{Class::smooth, first_order},    Row{Class::additive, first_order},     Row{Class::periodic, lattice_periodic},
    Row{Class::kink, first_order_kink}, Row{Class::axis_kink, first_order},    Row{Class::axis_jump, first_order},
    Row{Class::jump, net_jump},         Row{Class::corner, first_order_corner}};
constexpr std::array closed_lattice_rows = {Row{Class::smooth, lattice_closed},
                                            Row{Class::additive, lattice_closed_additive},
                                            Row{Class::axis_kink, lattice_closed}};
constexpr std::array interlaced_rows = {Row{Class::smooth, interlaced},
                                        Row{Class::additive, interlaced},
                                        Row{Class::periodic, interlaced},
                                        Row{Class::kink, interlaced_kink},
                                        Row{Class::axis_kink, interlaced_axis_kink},
                                        Row{Class::axis_jump, net_axis_jump},
                                        Row{Class::jump, net_jump},
                                        Row{Class::corner, net_corner}};
constexpr std::array learned_rows = {Row{Class::smooth, learned},    Row{Class::additive, learned},
                                     Row{Class::periodic, learned},  Row{Class::kink, learned},
                                     Row{Class::axis_kink, learned}, Row{Class::axis_jump, learned},
                                     Row{Class::jump, learned},      Row{Class::corner, learned}};

// The rows that hold for a sampler in d dimensions. Sets of fewer dimensions that are shuffled against each other see
// what is not additive over them as Latin hypercubes do [Owen98].
std::span<const Row> rows_of(std::string_view way, int d, bool closed) {
  if (way == "random") return random_rows;
  if (way == "stratified") return jittered_rows;
  // Its rounds are shares of N that tend to constants; grids of eight dimensions at most.
  if (way == "stratified_rounds" && d <= 8) return jittered_rows;
  if (way == "sobol") return net_rows;
  if (way == "halton") return d == 1 ? std::span<const Row>(net_rows) : halton_rows; // base two is a net of base two
  if (way == "lattice") return closed ? std::span<const Row>(closed_lattice_rows) : lattice_rows;
  if (way == "latin_hypercube") return d == 1 ? std::span<const Row>(jittered_rows) : latin_rows;
  if (way == "padded_sobol") return d <= 2 ? std::span<const Row>(net_rows) : latin_rows;
  if (way == "padded_sobol_4d") return d <= 4 ? std::span<const Row>(net_rows) : latin_rows;
  if (way == "multi_jittered") {
    if (d == 1) return jittered_rows;
    return d == 2 ? std::span<const Row>(correlated_rows) : latin_rows;
  }
  if (way == "rqmc") return d <= 2 ? std::span<const Row>(interlaced_rows) : net_rows;
  if (way == "vegas" || way == "tree" || way == "auto") return learned_rows;
  return {};
}

} // namespace

double Rate::local(double n) const { return exponent - log_power / std::log(n); }

bool Rate::allows(double lo, double hi, double n) const {
  const double slope = -local(n);
  return (bound == Bound::at_most || lo <= slope) && (bound == Bound::at_least || slope <= hi);
}

std::string Rate::to_string(int digits) const {
  static constexpr std::array words = {"", "no steeper than ", "at least as steep as "};
  return fmt::format("{}{:.{}f}", words[static_cast<std::size_t>(bound)], -exponent, digits);
}

std::optional<Rate> theory(std::string_view way, const Smoothness& smoothness, int dim) {
  if (smoothness.of == Class::corner && !(smoothness.a < 0.5)) return {};
  for (const Row& row : rows_of(way, dim, smoothness.closed))
    if (row.of == smoothness.of) return row.law(dim, smoothness.a);
  return {};
}

} // namespace carlo
