#pragma once
/// What the claimed density integrates to, and whether that is 1.

#include <mc/check/fit/expected/cubature.h>
#include <mc/check/fit/expected/stratified_reference.h>
#include <mc/check/report/report.h>

namespace mc {

/// The integral of the density by cubature, over boxes cut where the pilot fills only a corner of them: to a hundredth
/// of the standard deviation of a count of n, if max_evaluations suffice.
CubatureResult integrate_density(const Subject& subject, const Pilot& pilot, const PilotCells& cells, double n,
                                 std::size_t max_evaluations);

/// Sums over samples of the weights that Reference gives them.
struct SampleWeights {
  double draws = 0, points = 0; ///< all that were drawn, and those of them that were points of the domain
  double sum = 0, squares = 0;
  double total_points = 0; ///< points drawn in all, of the pilot too
};

/// Mass of density and outcomes.
///   by_cubature : by cubature, which reference and samples do not contradict; its error allows for what neither would
///                have seen. Else estimated from both
///   z          : by how many standard deviations the weights of the samples differ from what the reference expects
struct ClaimedMass {
  double value = 1, error = 0;
  double estimated = 1, estimated_error = 0, z = 0;
  double from_points = 1, from_points_error = 0; ///< by the random points alone, whatever the samples are
  bool by_cubature = true;
};
ClaimedMass claimed_mass(const Subject& subject, const CubatureResult& cubature, const EstimatedMass& reference,
                         const EstimatedMass& uncapped, const SampleWeights& samples);

/// Whether the mass is 1, or at most 1 where samples may fail. Spends alpha_share(mass) where it is estimated.
Check test_mass(const Subject& subject, const ClaimedMass& mass, double alpha);

} // namespace mc
