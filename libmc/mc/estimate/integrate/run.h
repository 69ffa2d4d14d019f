#pragma once
/// A run of integrate(): evaluates the integrand on sets of points and sums what it gives.

#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/mean.h>
#include <mc/estimate/integrate/sums.h>
#include <mc/estimate/point_set.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mc::detail {

/// Thrown by a run that was cancelled; never leaves integrate().
struct Cancelled {};

/// What points are drawn from.
///   all : the density p that was learned; a value is f / p
///   a part of the mixture q = 7 / 8 p + 1 / 8 of that and the uniform density, so that no value exceeds 8 f where p is
///   wrong: a value is (f - c p) / q, whose mean under q is that of f but for c. Near c p, where p is right, the
///   mixture costs next to nothing [OwenZhou00].
struct Proposal {
  enum class Part { all, of_density, of_uniform };
  static constexpr double uniform_share = 0.125;

  std::shared_ptr<const AdaptedDensity> density = {}; ///< none: uniform
  std::vector<double> centre = {};                    ///< c of each output
  Part part = Part::all;
};

/// One value or several, without a call through another for the one.
struct Integrand {
  const std::function<double(std::span<const double>)>* one = nullptr;
  const VectorIntegrand* several = nullptr;
  void operator()(std::span<const double> u, std::span<double> values) const {
    if (one) values[0] = (*one)(u);
    else (*several)(u, values);
  }
};

/// The integrand, the budget, the clock.
struct Run {
  Integrand f;
  std::size_t outputs;
  int dim;
  const IntegrateOptions& o;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t calls = 0;
  std::vector<Means> rounds = {}; ///< of learning: independent of each other and of the last means
  std::vector<double> chi2 = std::vector<double>(outputs), chi2_dof = std::vector<double>(outputs);

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  std::uint64_t left() const { return o.max_calls - calls; }
  /// Calls that may be recorded: 128 MB of points and values.
  std::uint64_t recordable() const { return (std::uint64_t{1} << 24) / (static_cast<std::uint64_t>(dim) + outputs); }

  /// Points [first, first + count) of each set; one result per set, with the same bits for any number of threads.
  ///   record : keeps the points and values with the sums
  ///   throws : Error where the integrand is not finite, with the point; Cancelled
  std::vector<Sums> evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                 const Proposal& proposal = {}, bool record = false);

  /// Whether the bare sequences, those of purpose 0, are interlaced. Under a grid they are not: smooth peaks would gain
  /// by it, but integrands that jump would lose.
  bool interlaced() const { return dim <= 2; }
  /// Replicates [first, last) of the sequences for a purpose.
  std::vector<PointSet> sobol_sets(std::uint64_t purpose, std::uint32_t first, std::uint32_t last) const;

  /// The means of replicates of so many points each; `evidence` holds one entry per output, or none at first.
  /// `uniform` are the sums of the uniform part where the replicates are those of the other part of a mixture.
  Means means(const std::vector<Sums>& replicates, std::uint64_t points, std::vector<Evidence>& evidence,
              const std::vector<Sums>& uniform = {}, const Proposal& proposal = {}) const;
  /// Adds to chi2 how far two independent means lie apart.
  void compare(const Means& a, const Means& b);

  bool converged(const Means& all) const;
  void report(const Means& all) const;

 private:
  Sums evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const Proposal& proposal,
                bool record) const;
  void require_finite(const Moments& m, const PointSet& set, const Proposal& proposal) const;
};

} // namespace mc::detail
