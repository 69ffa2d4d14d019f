#pragma once
/// Measures that carlo points reports for point sets, and their values for random and jittered sets.

#include <mc/points/discrepancy.h>
#include <mc/points/star_discrepancy.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace carlo {

/// Randomisations of a point set, which are made when they are measured: one for each thread is in memory.
struct PointSets {
  std::size_t count; ///< number of randomisations
  std::size_t dim;   ///< number of dimensions
  std::function<std::vector<double>(std::size_t i)> make;
};

/// Number of random sets, and of jittered sets, for the reference means that no formula gives. The star discrepancy is
/// expensive and varies little, so it uses only the first reference_stars of them.
constexpr int reference_sets = 16, reference_stars = 8;

/// Expected values: by formula for the spectrum and the L2 discrepancies (root mean squares), otherwise means over sets
/// with fixed seeds. Centered, wrap-around and mixture discrepancies of jittered points have no formula. t is empty if
/// it is unknown for one of the sets.
struct QualityReference {
  mc::L2Discrepancies l2;
  mc::StarDiscrepancy star{0, 0}; ///< means of both bounds
  double distance = 0;            ///< mean periodic distance
  std::optional<double> t;
  std::vector<double> power; ///< one value for each ring; empty in one dimension
};

/// Results for one number of points: the first set in full, and means over all randomisations.
struct QualityRow {
  std::uint64_t n = 0;
  mc::L2Discrepancies first_l2;
  mc::SmallestDistance first_distance{};
  mc::StarDiscrepancy star;  ///< star discrepancy of the first set
  std::optional<int> t;      ///< t of the first set
  mc::L2Discrepancies l2;    ///< root mean squares
  double distance = 0;       ///< mean periodic distance
  std::vector<double> power; ///< mean for each ring
  QualityReference random, jittered;
};

/// Step limits for the star discrepancy of the first set and of each reference set.
struct StarDiscrepancyBudget {
  std::uint64_t set, reference;
};

QualityRow measure_quality(const PointSets& sets, int threads, StarDiscrepancyBudget work);

/// The mean power in the rings of frequencies up to sqrt(n) / 2, which determines the error for smooth integrands.
double low_frequency_power(const std::vector<double>& power, std::uint64_t n);

} // namespace carlo
