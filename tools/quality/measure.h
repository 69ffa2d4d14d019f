#pragma once
/// What carlo points tells of point sets, and what it would tell of random and jittered ones.

#include <mc/points/discrepancy.h>
#include <mc/points/star_discrepancy.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace carlo {

using PointSets = std::vector<std::vector<double>>;

/// Sets whose means are drawn in where no formula gives the expectation: as many random and as many jittered ones. The
/// star discrepancy, which is dear and varies little, is that of the first reference_stars of them.
constexpr int reference_sets = 16, reference_stars = 8;

/// What would be expected: by formulas of the L2 discrepancies (root mean squares) and the spectrum, else means over
/// sets that have fixed seeds. No t where it is not known of each.
struct QualityReference {
  double l2_star = 0, l2_periodic = 0;
  mc::StarDiscrepancy star{0, 0}; ///< means of both bounds
  double distance = 0;            ///< periodic
  std::optional<double> t;
  std::vector<double> power; ///< by ring; empty in one dimension
};

/// One number of points: the first set in full, and means over all randomisations.
struct QualityRow {
  std::uint64_t n = 0;
  double first_l2_star = 0, first_l2_periodic = 0;
  mc::SmallestDistance first_distance{};
  mc::StarDiscrepancy star;            ///< of the first set
  std::optional<int> t;                ///< of the first set
  double l2_star = 0, l2_periodic = 0; ///< root mean squares
  double distance = 0;                 ///< mean, periodic
  std::vector<double> power;           ///< mean by ring
  QualityReference random, jittered;
};

/// Steps that may be spent on the star discrepancy of a set and of each of those for reference.
struct StarDiscrepancyBudget {
  std::uint64_t set, reference;
};

QualityRow measure_quality(const PointSets& sets, std::size_t dim, int threads, StarDiscrepancyBudget work);

/// The mean power of the rings of frequencies up to sqrt(n) / 2: what the set lets through of smooth integrands.
double low_frequency_power(const std::vector<double>& power, std::uint64_t n);

} // namespace carlo
