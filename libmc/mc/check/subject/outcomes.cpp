#include <mc/check/subject/outcomes.h>

#include <mc/core/sum.h>

#include <algorithm>
#include <cmath>

namespace mc {

Outcomes::Outcomes(double least, double greatest) : lo(least), hi(greatest) {
  if (std::isfinite(hi - lo)) {
    first = lo;
    last = hi;
  }
}

int Outcomes::index(double k) const {
  if (!(k == std::floor(k) && k >= lo && k <= hi && std::isfinite(k))) return -1;
  return k >= first && k <= last ? static_cast<int>(k - first) : listed();
}

void Outcomes::list(std::vector<double> samples) {
  constexpr double most = 1 << 20;
  std::erase_if(samples, [this](double k) { return !(k >= lo && k <= hi && std::isfinite(k)); });
  if (samples.empty()) samples = {std::clamp(0.0, lo, hi)};
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  const double median = std::floor(*middle);
  const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
  if (median - lo < most / 2) first = lo;
  else first = std::max(std::floor(*least), hi - median < most / 2 ? hi - most + 1 : median - most / 2);
  last = std::min({hi, std::floor(*greatest), first + most - 1});
}

void Outcomes::add_rest(std::vector<double>& probabilities) const {
  if (!has_rest()) return;
  CompensatedSum sum;
  for (const double p : probabilities) sum.add(p);
  probabilities.push_back(std::max(1 - sum.value(), 0.0));
}

} // namespace mc
