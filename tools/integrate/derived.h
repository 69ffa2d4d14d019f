#pragma once
/// Functions of several integrals, with the error that their covariance gives.

#include <report/integrate_output.h>

#include <mc/estimate/integrate.h>

#include <string>
#include <vector>

namespace carlo {

/// The value of an expression over the integrals first, first + 1, ... of r, by their names.
///   error    : sqrt(g C g) for the covariance C of the integrals and the gradient g of the function, from differences
///              over one standard error on each side.
///   interval : the value with as many standard errors on each side as the longest interval of an integral in it has.
///   linear   : the terms of second order, with covariance C, are less than half a standard error (RMS).
///   throws   : Error that names --derive for an expression that does not parse.
DerivedValue derived_value(const std::string& expression, const std::vector<std::string>& names,
                           const mc::VectorIntegral& r, std::size_t first);

} // namespace carlo
