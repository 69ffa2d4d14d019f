#include <mc/core/erf.h>

#include <boost/math/special_functions/erf.hpp>

namespace mc {

float erfc(float x) { return boost::math::erfc(x); }
double erfc(double x) { return boost::math::erfc(x); }
float erfc_inv(float p) { return boost::math::erfc_inv(p); }
double erfc_inv(double p) { return boost::math::erfc_inv(p); }

} // namespace mc
