#include <mc/table/alias_table.h>
#include <mc/table/cdf.h>

namespace mc {

AliasTable::AliasTable(std::span<const double> weights) {
  const Cdf cdf(weights); // checks the weights and keeps every positive weight reachable
  const std::size_t n = cdf.size();
  bins_.resize(n);
  std::vector<double> share(n); // share of a bin in units of 1 / n
  std::vector<std::uint32_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    bins_[i].pmf = cdf.pmf(i);
    share[i] = cdf.pmf(i) * static_cast<double>(n);
    (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    bins_[s].threshold = share[s];
    bins_[s].alias = l;
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // The remaining shares are 1 up to rounding. An outcome of weight 0 stays small while a large outcome remains. If
  // rounding has used up the large ones, it gives its bin to the most likely outcome.
  std::uint32_t likely = 0;
  for (std::uint32_t i = 0; i < n; ++i)
    if (pmf(i) > pmf(likely)) likely = i;
  for (const std::uint32_t i : large) {
    bins_[i].threshold = 1;
    bins_[i].alias = i;
  }
  for (const std::uint32_t i : small) {
    bins_[i].threshold = pmf(i) > 0;
    bins_[i].alias = pmf(i) > 0 ? i : likely;
  }
}

} // namespace mc
