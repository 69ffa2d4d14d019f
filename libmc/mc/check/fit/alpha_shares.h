#pragma once
/// Shares of the family-wise alpha among the tests of check_subject.

#include <array>
#include <cstdint>

namespace mc {

/// The statistical tests of a subject. A test that runs several times (per axis, per level of the tree, per pair of
/// axes) divides its share evenly among its repetitions.
enum class FitTest : std::uint8_t {
  chi_square,
  single_cells,
  tails,
  ks,
  correlation,
  atoms,
  gaps,
  failures,
  inverse,
  mass,
  marginal_bins,
  spectrum,
  density_ratio
};

/// Share of one test in the family-wise alpha.
struct AlphaShare {
  FitTest test;
  double discrete, one_axis, more_axes; ///< share of alpha for subjects without axes, with one, with two or three

  constexpr double at_dimension(int dim) const {
    if (dim == 0) return discrete;
    return dim == 1 ? one_axis : more_axes;
  }
};

/// Scores (tails) are the most powerful tests against common faults of distributions.
inline constexpr std::array<AlphaShare, 13> alpha_shares{{
    {FitTest::chi_square, 0.61, 0.22, 0.22},
    {FitTest::single_cells, 0.30, 0.12, 0.12},
    {FitTest::tails, 0, 0.28, 0.28},
    {FitTest::ks, 0, 0.17, 0.11},
    {FitTest::correlation, 0, 0, 0.06},
    {FitTest::atoms, 0, 0.03, 0.03},
    {FitTest::gaps, 0, 0.02, 0.02},
    {FitTest::failures, 0.03, 0.03, 0.03},
    {FitTest::inverse, 0, 0.01, 0.01},
    {FitTest::mass, 0, 0.02, 0.02},
    {FitTest::marginal_bins, 0, 0.03, 0.03},
    {FitTest::density_ratio, 0, 0.02, 0.02},
    {FitTest::spectrum, 0, 0.05, 0.05},
}};

/// Returns the share of alpha that all repetitions of a test spend together on a subject with `dim` axes.
constexpr double alpha_share(FitTest test, int dim) {
  for (const AlphaShare& s : alpha_shares)
    if (s.test == test) return s.at_dimension(dim);
  return 0;
}

} // namespace mc
