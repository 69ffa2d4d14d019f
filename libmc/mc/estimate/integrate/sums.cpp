#include <mc/estimate/integrate/sums.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

void ScaledMoments::rescale(int exponent) {
  moments_ = moments_.scaled(exponent_ - exponent);
  exponent_ = exponent;
}

void ScaledMoments::add(std::span<double> values, std::uint64_t first, double largest) {
  if (largest > 0 && std::isfinite(largest)) {
    const int size = std::ilogb(largest);
    const bool nothing_yet = moments_.mean() == 0 && moments_.variance() == 0;
    if (size - exponent_ > 256 || (nothing_yet && size - exponent_ < -256)) rescale(size);
  }
  if (exponent_ != 0)
    for (double& x : values) x = std::ldexp(x, -exponent_);
  moments_.add(values, first);
}

void ScaledMoments::merge(const ScaledMoments& other) {
  ScaledMoments theirs = other;
  if (theirs.exponent_ != exponent_) {
    // Zeros have no size: they take that of the others.
    const auto empty = [](const ScaledMoments& s) { return s.moments_.mean() == 0 && s.moments_.variance() == 0; };
    const int exponent = empty(*this)    ? theirs.exponent_
                         : empty(theirs) ? exponent_
                                         : std::max(exponent_, theirs.exponent_);
    rescale(exponent);
    theirs.rescale(exponent);
  }
  moments_.merge(theirs.moments_);
}

double ScaledMoments::mean() const { return std::ldexp(moments_.mean(), exponent_); }
double ScaledMoments::std_error() const { return std::ldexp(moments_.std_error(), exponent_); }
double ScaledMoments::variation() const { return std::ldexp(std::sqrt(moments_.variance()), exponent_); }

void Sums::merge(const Sums& other) {
  if (outputs.empty()) {
    *this = other;
    return;
  }
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    outputs[k].merge(other.outputs[k]);
    magnitudes[k].merge(other.magnitudes[k]);
  }
  points.insert(points.end(), other.points.begin(), other.points.end());
  values.insert(values.end(), other.values.begin(), other.values.end());
}

} // namespace mc::detail
