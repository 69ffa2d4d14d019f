#pragma once
/// The 50-digit scalar over which every warp is its own high-precision oracle.

#include <mc/core/types.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace mc {

/// Expression templates are off, so that `auto`, ternaries and Eigen treat it as a plain number.
using Oracle = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

} // namespace mc
