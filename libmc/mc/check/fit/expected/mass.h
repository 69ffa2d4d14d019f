#pragma once
/// The integral of the claimed density, and the test that it is 1.

#include <mc/check/fit/expected/cubature.h>
#include <mc/check/fit/expected/stratified_reference.h>
#include <mc/check/report/report.h>

namespace mc {

/// Returns the integral of the density by cubature, accurate to a hundredth of the standard deviation of a count of n
/// if max_evaluations suffice. Boxes are cut finer if the pilot fills only a corner of them. In more than three
/// dimensions there is no cubature: the error is infinite.
CubatureResult integrate_density(const Subject& subject, const Pilot& pilot, const PilotCells& cells, double n,
                                 std::size_t max_evaluations);

/// Sums over samples of the weights from StratifiedReference.
struct SampleWeights {
  double draws = 0, points = 0; ///< number of draws, and of the draws that are points of the domain
  double sum = 0, squares = 0;
  double total_points = 0; ///< number of all points, including the pilot
};

/// Mass of density and outcomes.
///   by_cubature : whether `value` comes from cubature, confirmed by reference and samples. Its error includes mass
///                 that both may have missed. Otherwise `value` is estimated from reference and samples.
///   z           : deviation of the samples' weights from the reference, in standard deviations.
struct ClaimedMass {
  double value = 1, error = 0;
  double estimated = 1, estimated_error = 0, z = 0;
  double from_points = 1, from_points_error = 0; ///< from the random points alone, independent of the samples
  bool by_cubature = true;
};
ClaimedMass claimed_mass(const Subject& subject, const CubatureResult& cubature, const EstimatedMass& reference,
                         const EstimatedMass& uncapped, const SampleWeights& samples);

/// Tests that the mass is 1, or at most 1 if samples may fail. Spends a share of alpha if the mass is estimated.
Check test_mass(const Subject& subject, const ClaimedMass& mass, double share, double alpha);

} // namespace mc
