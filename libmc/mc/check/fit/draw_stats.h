#pragma once
/// Draws of a subject, and what single draws show.

#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <functional>
#include <span>
#include <vector>

namespace mc {

/// Counts of what single draws break, each with its first witness.
struct DrawStats {
  struct Violation {
    std::uint64_t count = 0, seed = 0, index = 0; ///< the witness is draw `index` of stream `seed`
  };
  Violation failed, outside, not_finite, weight;
  Violation zero_pdf, non_finite_pdf; ///< pdf = 0; it is not finite
  Violation negative_pdf;             ///< pdf < 0
  Violation boundary_zero_pdf,
      boundary_non_finite_pdf; ///< the same where the density is right beside it: on a face of the chart, at a jump
  double max_weight_error = 0; ///< largest |weight - 1| beyond what the density changes within four steps of rounding
  std::uint64_t draws = 0;
  std::vector<std::uint64_t> atoms; ///< count of each discrete outcome
};

/// Called with points of the domain and the densities there, many at a time, in the order of the draws.
using PointsCallback = std::function<void(std::span<const Subject::Coordinates> v, std::span<const double> densities)>;

/// Draws n samples of streams that follow from `seed`, and hands the points over.
///   on_progress : called after 1024, 2048, ... draws, but not all, when their points have been handed over; may be empty
///   throws : Error when the subject draws nothing
DrawStats draw_samples(const Subject& subject, std::uint64_t seed, std::uint64_t n, const PointsCallback& points,
                       const std::function<void(const DrawStats& stats)>& on_progress = {});

/// The draws of both; atoms are those of `a`.
DrawStats merge(DrawStats a, const DrawStats& b);

/// One Check for each law of single draws: finite, in the domain, pdf > 0, weight, never fails, and no outcome of
/// probability 0 among `atoms`; inconclusive where there is no sample at all. With `open_interval` the pdf is free on
/// the faces of the chart.
std::vector<Check> check_draws(const Subject& subject, const DrawStats& stats, bool open_interval = false);

} // namespace mc
