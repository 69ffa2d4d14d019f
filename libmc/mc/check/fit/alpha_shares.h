#pragma once
/// How the tests of check_subject share the family-wise alpha.

#include <array>
#include <cstdint>

namespace mc {

/// The statistical tests of a subject. Where one is made several times (per axis, per level of the tree, per pair of
/// axes) its share is divided evenly among them.
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

struct AlphaShare {
  FitTest test;
  double discrete, one_axis, more_axes; ///< share of alpha for subjects without axes, with one, with two or three

  constexpr double at_dimension(int dim) const {
    if (dim == 0) return discrete;
    return dim == 1 ? one_axis : more_axes;
  }
};

/// The scores (tails) are the most powerful against the faults that samplers have.
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

/// The share of alpha that a test spends on a subject with `dim` axes, all its repetitions together.
constexpr double alpha_share(FitTest test, int dim) {
  for (const AlphaShare& s : alpha_shares)
    if (s.test == test) return s.at_dimension(dim);
  return 0;
}

} // namespace mc
