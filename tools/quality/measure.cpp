#include <quality/measure.h>
#include <sampling/point_sets.h>

#include <mc/core/parallel.h>
#include <mc/points/net.h>
#include <mc/points/spectrum.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

struct Quality {
  mc::L2Discrepancies l2;
  mc::SmallestDistance distance;
  std::vector<double> power;
};

Quality quality_of(mc::PointList p, int rings) {
  return {mc::l2_discrepancies(p), mc::smallest_distance(p),
          rings > 0 ? mc::radial_power_spectrum(p, rings) : std::vector<double>()};
}

constexpr double mc::L2Discrepancies::*l2_members[] = {&mc::L2Discrepancies::star, &mc::L2Discrepancies::periodic,
                                                       &mc::L2Discrepancies::centered, &mc::L2Discrepancies::wraparound,
                                                       &mc::L2Discrepancies::mixture};

// Root mean squares over sets with a member `l2`.
template <class Sets> mc::L2Discrepancies l2_of(const Sets& sets) {
  mc::L2Discrepancies mean;
  for (const auto member : l2_members) {
    for (const auto& set : sets) mean.*member += set.l2.*member * set.l2.*member / static_cast<double>(sets.size());
    mean.*member = std::sqrt(mean.*member);
  }
  return mean;
}

// The measures that have no formula.
struct ReferenceSetQuality {
  mc::L2Discrepancies l2;
  mc::StarDiscrepancy star;
  double distance = 0;
  std::optional<int> t;
};

// Measures of a reference set: the random sets come first, then the jittered ones.
ReferenceSetQuality reference_set_quality(std::uint64_t index, std::uint64_t n, std::size_t dim, std::uint64_t work) {
  const PointSet& set = point_set(index < reference_sets ? "random" : "stratified");
  const std::vector<double> x =
      set.make(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(dim), mc::hash(0x9eed, index));
  const mc::PointList p{x, dim};
  const bool star = index % reference_sets < reference_stars;
  return {mc::l2_discrepancies(p), star ? mc::star_discrepancy(p, work) : mc::StarDiscrepancy{0, 0},
          mc::smallest_distance(p).periodic, mc::net_quality(p, 10'000'000)};
}

QualityReference means(std::span<const ReferenceSetQuality> all) {
  QualityReference mean;
  const double share = 1.0 / static_cast<double>(all.size());
  mean.t = 0;
  mean.l2 = l2_of(all);
  for (const ReferenceSetQuality& d : all) {
    mean.star.lower += d.star.lower / reference_stars;
    mean.star.upper += d.star.upper / reference_stars;
    mean.distance += d.distance * share;
    if (d.t && mean.t) *mean.t += *d.t * share;
    else mean.t.reset();
  }
  return mean;
}

} // namespace

QualityRow measure_quality(const PointSets& sets, int threads, StarDiscrepancyBudget work) {
  QualityRow row;
  const std::size_t dim = sets.dim;
  const std::vector<double> first = sets.make(0);
  row.n = first.size() / dim;
  const double n = static_cast<double>(row.n), count = static_cast<double>(sets.count);
  const int rings = dim < 2 ? 0 : std::clamp(static_cast<int>(std::lround(2 * std::sqrt(n))), 4, 128);
  const auto axes = static_cast<int>(dim);
  std::vector<Quality> all(sets.count);
  std::vector<ReferenceSetQuality> others(2 * reference_sets);
  // The longest task comes first.
  mc::parallel_for(1 + others.size() + sets.count, threads, [&](std::size_t i) {
    if (i == 0) {
      row.star = mc::star_discrepancy({first, dim}, work.set);
      row.t = mc::net_quality({first, dim});
    } else if (i <= others.size()) {
      others[i - 1] = reference_set_quality(i - 1, row.n, dim, work.reference);
    } else {
      const std::size_t r = i - 1 - others.size();
      const std::vector<double> set = sets.make(r);
      all[r] = quality_of({set, dim}, rings);
    }
  });
  row.first_l2 = all[0].l2;
  row.l2 = l2_of(all);
  row.first_distance = all[0].distance;
  row.power.assign(static_cast<std::size_t>(rings), 0.0);
  for (const Quality& q : all) {
    row.distance += q.distance.periodic / count;
    for (std::size_t k = 0; k < row.power.size(); ++k) row.power[k] += q.power[k] / count;
  }
  row.random = means(std::span(others).first(reference_sets));
  row.jittered = means(std::span(others).subspan(reference_sets));
  row.random.l2 = mc::random_l2_discrepancies(n, axes);
  row.jittered.l2.star = std::sqrt(mc::jittered_star_mean_square(n, axes));
  row.jittered.l2.periodic = std::sqrt(mc::jittered_periodic_mean_square(n, axes));
  row.random.power.assign(row.power.size(), 1.0);
  if (dim >= 2) row.jittered.power = mc::jittered_radial_spectrum(std::pow(n, 1.0 / axes), rings);
  return row;
}

double low_frequency_power(const std::vector<double>& power, std::uint64_t n) {
  const auto rings = static_cast<std::size_t>(
      std::clamp(std::sqrt(static_cast<double>(n)) / 2, 1.0, static_cast<double>(power.size())));
  double sum = 0;
  for (std::size_t k = 0; k < rings; ++k) sum += power[k];
  return sum / static_cast<double>(rings);
}

} // namespace carlo
