#pragma once
/// The integrals of the books, each with its true value.

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// An integral over the unit cube.
struct Experiment {
  std::string name;
  std::string title; ///< one line, for lists and plots
  std::string source;
  int dim;
  double truth;
  /// Exponent with which the RMS error of jittered sampling falls: -1/2 - 1/d for a smooth integrand, -1/2 - 1/(2 d)
  /// for the indicator of a body [MitchellA96]; 0: none stated, since there is no error, or a derivative is infinite.
  double stratified_slope;
  double fit_from;                                  ///< smallest N in the asymptotic range
  std::function<double(std::span<const double>)> f; ///< of u in [0,1)^dim; its mean is the integral
};

const std::vector<Experiment>& experiments();

/// The experiment of that name. Throws mc::Error naming the nearest for an unknown one.
const Experiment& experiment(const std::string& name);

} // namespace carlo
