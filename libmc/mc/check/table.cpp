#include <mc/check/table.h>

namespace mc {

// Each law is one file of laws/ and one row here. A law without checks reports what the distribution lacks.
Law boundary_law, determinism_law, batch_consistency_law, support_law, inverse_law, jacobian_law, precision_law;

namespace {

constexpr LawRow<AnyDistribution, LawOptions> distribution_rows[] = {
    {"boundary and branches of u", boundary_law, "sample takes no u"},
    {"determinism", determinism_law, "sample takes no u"},
    {"batch consistency", batch_consistency_law, "sample takes one u at a time"},
    {"pdf > 0 where eval > 0", support_law, "no eval"},
    {"invert(sample(u)) = u", inverse_law, "no invert"},
    {"|det| pdf = 1", jacobian_law, "needs invert, as many u as dimensions, and double or 50 digits"},
    {"float and double against 50 digits", precision_law, "no cast to 50 digits"},
};

} // namespace

std::span<const LawRow<AnyDistribution, LawOptions>> distribution_laws() { return distribution_rows; }

// Each law of BSDFs is one file of laws/bsdf/ and one row here.
using BsdfLaw = Findings(const BsdfView& view);
BsdfLaw bsdf_sign_law, bsdf_support_law, bsdf_reciprocity_law, bsdf_delta_reciprocity_law, bsdf_energy_law;

namespace {

// A law of distributions, for the directions wi.
template <Law law> Findings of_directions(const BsdfView& view) {
  return law(view.distribution, {.statistics = view.options.statistics});
}

constexpr LawRow<BsdfView> bsdf_rows[] = {
    {"boundary and branches of u", of_directions<boundary_law>, nullptr},
    {"determinism", of_directions<determinism_law>, nullptr},
    {"f finite and >= 0", bsdf_sign_law, nullptr},
    {"pdf > 0 where f > 0", bsdf_support_law, nullptr},
    {"reciprocity", bsdf_reciprocity_law, "reciprocal = false"},
    {"reciprocity of delta lobes", bsdf_delta_reciprocity_law, nullptr},
    {"energy <= 1", bsdf_energy_law, nullptr},
};

} // namespace

std::span<const LawRow<BsdfView>> bsdf_laws() { return bsdf_rows; }

using RoughnessLaw = Findings(const RoughnessFamily& family);
RoughnessLaw roughness_samples_law, roughness_evals_law;

namespace {

constexpr LawRow<RoughnessFamily> roughness_rows[] = {
    {"sample tends to its smooth limit", roughness_samples_law, nullptr},
    {"eval is continuous in roughness", roughness_evals_law, nullptr},
};

} // namespace

std::span<const LawRow<RoughnessFamily>> roughness_laws() { return roughness_rows; }

// Each statistical test is one file of fit/tests/ and one row here. Scores (tails) are the most powerful tests against
// common faults of distributions, and so have the largest share.
using StartTest = FitTest(const FitSetup& setup, double share);
StartTest draws_law, density_law, resolution_law, mass_test, uniformity_test, inverted_spectrum_test, atoms_test,
    chi_square_test, single_cells_test, tails_test, ks_test_of_cells, correlation_test, gaps_test, marginal_bins_test,
    density_ratio_test, spectrum_test, grid_test, failures_test;

namespace {

bool any(const Subject&) { return true; }
bool has_axes(const Subject& s) { return s.dim > 0; }
bool has_pairs_of_axes(const Subject& s) { return s.dim > 1; }
bool has_few_axes(const Subject& s) { return s.dim > 0 && s.dim <= 3; }
bool has_inverse(const Subject& s) { return static_cast<bool>(s.inverted); }
bool may_fail(const Subject& s) { return s.may_fail; }

// Share of alpha for discrete outcomes, for one axis, and for more axes.
constexpr FitTestRow fit_test_rows[] = {
    {"every sample", {}, any, draws_law},
    {"density", {}, any, density_law},
    {"resolution", {}, has_axes, resolution_law},
    {"mass", {0, 0.02, 0.02}, any, mass_test},
    {"inverted samples", {0, 0.01, 0.01}, has_inverse, uniformity_test},
    {"Fourier", {0, 0.05, 0.05}, has_inverse, inverted_spectrum_test},
    {"atoms", {0, 0.03, 0.03}, has_axes, atoms_test},
    {"chi-square", {0.61, 0.17, 0.17}, any, chi_square_test, true},
    {"single cells", {0.30, 0.10, 0.10}, any, single_cells_test, true},
    {"tails", {0, 0.19, 0.19}, has_axes, tails_test, true},
    {"KS", {0, 0.13, 0.08}, has_axes, ks_test_of_cells, true},
    {"correlation", {0, 0, 0.05}, has_pairs_of_axes, correlation_test, true},
    {"gaps", {0, 0.02, 0.02}, has_axes, gaps_test}, // after the tests of cells, which also find wide gaps
    {"marginal bins", {0, 0.03, 0.03}, has_axes, marginal_bins_test},
    {"density ratio", {0, 0.02, 0.02}, has_axes, density_ratio_test},
    {"Fourier", {0, 0.05, 0.05}, has_axes, spectrum_test},
    {"grid", {0, 0.20, 0.20}, has_few_axes, grid_test},
    {"failure rate", {0.03, 0.03, 0.03}, may_fail, failures_test},
};

} // namespace

std::span<const FitTestRow> fit_tests() { return fit_test_rows; }

// Each explanation is one file of fit/explanations/ and one row here.
using Explain = void(const FitCounts& counts, std::vector<TestFindings>& findings);
Explain explain_mass_by_rounding, explain_mass_by_samples, explain_by_region, explain_by_rotation,
    explain_by_coarse_axes;

namespace {

constexpr ExplanationRow explanation_rows[] = {
    {"rounding of the density", explain_mass_by_rounding},
    {"wrong samples, not a wrong mass", explain_mass_by_samples},
    {"worst region", explain_by_region},
    {"rotation", explain_by_rotation},
    {"rounding of the samples", explain_by_coarse_axes},
};

} // namespace

std::span<const ExplanationRow> explanations() { return explanation_rows; }

} // namespace mc
