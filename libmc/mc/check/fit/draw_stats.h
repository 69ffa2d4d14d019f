#pragma once
/// Draws of a subject, and statistics of single draws.

#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <functional>
#include <span>
#include <vector>

namespace mc {

/// Counts of draws that violate a law, with the first witness of each law.
struct DrawStats {
  /// Number of violations of one law, and the first.
  struct Violation {
    std::uint64_t count = 0, seed = 0, index = 0; ///< the witness is draw `index` of stream `seed`
  };
  Violation failed, outside, not_finite, weight;
  Violation zero_pdf, non_finite_pdf; ///< pdf = 0; pdf is not finite
  Violation negative_pdf;             ///< pdf < 0
  /// pdf = 0 and pdf not finite at points with a correct density next to them: on a face of the chart or at a jump. The
  /// second includes every pdf at Draw::at_pole.
  Violation boundary_zero_pdf, boundary_non_finite_pdf;
  /// Largest |weight - 1| beyond the change of the density within four steps of rounding.
  double max_weight_error = 0;
  std::uint64_t draws = 0;          ///< number of draws
  std::vector<std::uint64_t> atoms; ///< count of each discrete outcome
};

/// Receives points of the domain and their densities in batches, in the order of the draws.
using PointsCallback = std::function<void(std::span<const Subject::Coordinates> v, std::span<const double> densities)>;

/// Draws n samples of streams derived from `seed` and passes the points to `points`.
///   on_progress : called after 1024, 2048, ... draws, except after the last, once `points` has received their points;
///                 may be empty.
///   throws      : Error if the subject draws nothing.
DrawStats draw_samples(const Subject& subject, std::uint64_t seed, std::uint64_t n, const PointsCallback& points,
                       const std::function<void(const DrawStats& stats)>& on_progress = {});

/// Returns the sums of both; `atoms` comes from `a`.
DrawStats merge(DrawStats a, const DrawStats& b);

/// Returns one Check for each law of single draws: finite, in the domain, pdf > 0, weight, never fails, no outcome of
/// probability 0. Without any sample the result is inconclusive. With `open_interval` the pdf is not checked on the
/// faces of the chart.
std::vector<Check> check_draws(const Subject& subject, const DrawStats& stats, bool open_interval = false);

} // namespace mc
