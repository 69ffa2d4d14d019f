#include <mc/estimate/diagnostics/octave_histogram.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {

void OctaveHistogram::raise(int top) {
  if (top <= top_) return;
  std::array<std::uint64_t, octaves> moved{};
  for (int i = 0; i < octaves; ++i)
    moved[static_cast<std::size_t>(std::min(i + (top - top_), octaves - 1))] += below_[static_cast<std::size_t>(i)];
  below_ = moved;
  top_ = top;
}

void OctaveHistogram::add(std::span<const double> values) {
  for (const double x : values) {
    const int exponent = biased_exponent(x);
    if (exponent == 0x7ff) continue;
    if (exponent > top_) [[unlikely]]
      raise(exponent);
    ++below_[static_cast<std::size_t>(std::min(top_ - exponent, octaves - 1))];
    zeros_ += x == 0;
    if (count_++ == 0) lo_ = hi_ = x;
    lo_ = std::min(lo_, x);
    hi_ = std::max(hi_, x);
  }
}

void OctaveHistogram::merge(const OctaveHistogram& other) {
  if (other.count_ == 0) return;
  lo_ = count_ > 0 ? std::min(lo_, other.lo_) : other.lo_;
  hi_ = count_ > 0 ? std::max(hi_, other.hi_) : other.hi_;
  count_ += other.count_;
  zeros_ += other.zeros_;
  raise(other.top_);
  for (int i = 0; i < octaves; ++i)
    below_[static_cast<std::size_t>(std::min(i + (top_ - other.top_), octaves - 1))] +=
        other.below_[static_cast<std::size_t>(i)];
}

double OctaveHistogram::mean_magnitude() const {
  constexpr int bias = 1023;
  double sum = 0; // in units of the largest octave, so that nothing overflows
  for (int i = 0; i + 1 < octaves; ++i) sum += std::ldexp(static_cast<double>(below_[static_cast<std::size_t>(i)]), -i);
  return sum > 0 ? std::ldexp(sum / static_cast<double>(count_), top_ - bias) : 0.0;
}

double OctaveHistogram::Largest::index() const {
  const std::uint64_t steps = (octaves - 1) * count - octave_sum; // sum of the steps above the threshold
  if (count == 0 || steps == 0) return std::numeric_limits<double>::infinity();
  return std::log2(1 + static_cast<double>(count) / static_cast<double>(steps));
}

// Omits the last octave, which also contains zeros.
OctaveHistogram::Largest OctaveHistogram::largest(std::uint64_t least) const {
  Largest found;
  while (found.count < least && found.octaves + 1 < octaves) found.add(below_[found.octaves]);
  return found;
}

double OctaveHistogram::tail_index(std::uint64_t least) const {
  const Largest found = largest(least);
  return found.count < least ? std::numeric_limits<double>::infinity() : found.index();
}

OctaveHistogram::Largest OctaveHistogram::sixteen_largest() const {
  const std::uint64_t least = std::min<std::uint64_t>(16, count_ - zeros_);
  Largest found = largest(least);
  if (found.count < least) found.add(least - found.count);
  return found;
}

bool OctaveHistogram::undersampled() const {
  const bool single = zeros_ >= 100 && count_ - zeros_ == 1; // further values may have any size
  return single || sixteen_largest().index() < 0.5;
}

double OctaveHistogram::extrapolated_tail_mean() const {
  const double index = std::max(sixteen_largest().index(), 1.1);
  if (std::isinf(index)) return 0;
  return index / (index - 1) * (std::max(std::abs(lo_), std::abs(hi_)) / static_cast<double>(count_));
}

double OctaveHistogram::tail_index() const {
  const double few = tail_index(few_largest()), many = tail_index(many_largest());
  return few > 1.3 * many ? std::numeric_limits<double>::infinity() : few;
}

} // namespace mc
