#include <sampling/theory.h>

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

Rate jittered(double d, double) { return {0.5 + 1 / d, 0, "Haber 1966; [MitchellA96]"}; }
Rate jittered_jump(double d, double) { return {jump(d), 0, "[MitchellA96]"}; }
Rate jittered_corner(double d, double a) { return {0.5 + (1 - 2 * a) / (2 * d), 0, "cells at the singular faces"}; }

constexpr std::string_view owen = "Owen 1997", he_wang = "He and Wang 2015", order_one = "Kuo, Schwab and Sloan 2012";

Rate net(double d, double) { return {1.5, (d - 1) / 2, owen}; }
Rate net_additive(double, double) { return {1.5, 0, owen}; }
Rate net_kink(double d, double) { return {std::min(1.5, kink(d)), 0, "cells at the surface"}; }
Rate net_axis_jump(double d, double) { return {1, (d - 1) / 2, he_wang}; }
Rate net_jump(double d, double) { return {jump(d), 0, he_wang}; }
Rate net_corner(double, double a) { return {1 - a, 0, "Owen 2006; Liu 2024"}; }

Rate first_order(double, double) { return {1, 0, order_one, true}; }
Rate first_order_kink(double d, double) { return {std::min(1.0, kink(d)), 0, "cells at the surface", true}; }
Rate first_order_corner(double, double a) { return {1 - a, 0, "Owen 2006", true}; }
Rate halton_smooth(double, double) { return {1, 0, "Owen and Pan 2023", true}; }

Rate hypercube_additive(double, double) { return {1.5, 0, "Stein 1987"}; }
Rate correlated_smooth(double, double) { return {0.75, 0, "[Kensler13]: one of n strata of an axis moves at once"}; }

Rate interlaced(double, double) { return {2.5, 0, "Dick 2011"}; }
Rate interlaced_kink(double d, double) { return {std::min(2.5, kink(d)), 0, "cells at the surface"}; }

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
constexpr std::array hypercube_rows = {Row{Class::smooth, random_law},    Row{Class::additive, hypercube_additive},
                                       Row{Class::periodic, random_law},  Row{Class::kink, random_law},
                                       Row{Class::axis_kink, random_law}, Row{Class::axis_jump, random_law},
                                       Row{Class::jump, random_law},      Row{Class::corner, random_law}};
constexpr std::array correlated_rows = {Row{Class::smooth, correlated_smooth}, Row{Class::additive, hypercube_additive},
                                        Row{Class::periodic, hypercube_additive},
                                        Row{Class::axis_jump, correlated_smooth}, Row{Class::jump, correlated_smooth}};
constexpr std::array halton_rows = {Row{Class::smooth, halton_smooth},    Row{Class::additive, halton_smooth},
                                    Row{Class::periodic, halton_smooth},  Row{Class::kink, first_order_kink},
                                    Row{Class::axis_kink, halton_smooth}, Row{Class::axis_jump, halton_smooth},
                                    Row{Class::jump, net_jump},           Row{Class::corner, first_order_corner}};
constexpr std::array lattice_rows = {Row{Class::smooth, first_order},       Row{Class::additive, first_order},
                                     Row{Class::kink, first_order_kink},    Row{Class::axis_kink, first_order},
                                     Row{Class::axis_jump, first_order},    Row{Class::jump, net_jump},
                                     Row{Class::corner, first_order_corner}};
constexpr std::array interlaced_rows = {Row{Class::smooth, interlaced},    Row{Class::additive, interlaced},
                                        Row{Class::kink, interlaced_kink}, Row{Class::axis_jump, net_axis_jump},
                                        Row{Class::jump, net_jump},        Row{Class::corner, net_corner}};

// The rows that hold for a sampler in d dimensions. Sets of fewer dimensions that are shuffled against each other see
// what is not additive over them as Latin hypercubes do (Owen 1998).
std::span<const Row> rows_of(std::string_view way, int d) {
  if (way == "random") return random_rows;
  if (way == "stratified") return jittered_rows;
  if (way == "sobol") return net_rows;
  if (way == "halton") return d == 1 ? std::span<const Row>() : halton_rows;
  if (way == "lattice") return lattice_rows;
  if (way == "latin_hypercube") return d == 1 ? std::span<const Row>(jittered_rows) : hypercube_rows;
  if (way == "padded_sobol") return d <= 2 ? std::span<const Row>(net_rows) : hypercube_rows;
  if (way == "padded_sobol_4d") return d <= 4 ? std::span<const Row>(net_rows) : hypercube_rows;
  if (way == "multi_jittered") {
    if (d == 1) return jittered_rows;
    return d == 2 ? std::span<const Row>(correlated_rows) : hypercube_rows;
  }
  if (way == "rqmc") return d <= 2 ? std::span<const Row>(interlaced_rows) : net_rows;
  return {}; // vegas, tree and auto choose by what they measure
}

} // namespace

double Rate::local(double n) const { return exponent - log_power / std::log(n); }

std::optional<Rate> theory(std::string_view way, const Smoothness& smoothness, int dim) {
  for (const Row& row : rows_of(way, dim))
    if (row.of == smoothness.of) return row.law(dim, smoothness.a);
  return {};
}

} // namespace carlo
