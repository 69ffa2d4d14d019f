#pragma once
/// Numerical integration over the unit cube, a domain or a warp, to a given error. See docs/methods/integrate.md.

#include <mc/core/error.h>
#include <mc/domain/concept.h>
#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/estimate.h>
#include <mc/run/executor.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// Integration method; see integrate_unit() for the algorithms.
enum class Method {
  automatic,  ///< Selects one of rqmc, vegas and tree during the run.
  plain,      ///< Independent points.
  stratified, ///< Jittered points.
  rqmc,       ///< Scrambled Sobol' sequences.
  vegas,      ///< rqmc with importance sampling by a learned grid.
  tree        ///< rqmc with importance sampling by a learned grid and tree.
};
/// Name of a method, such as "rqmc".
std::string_view name(Method method);
/// Inverse of name(). Throws Error for an unknown name; the message suggests the nearest method.
Method parse_method(std::string_view name);

/// Reason for the end of an integration.
enum class StopReason {
  converged, ///< A tolerance was reached.
  max_calls, ///< The calls were exhausted.
  cancelled  ///< IntegrateOptions::cancel became true.
};
/// Name of a reason.
std::string_view name(StopReason stop);

/// Reliability of an error bar.
enum class ErrorBar {
  known,             ///< The standard error is valid.
  all_zero,          ///< All sampled values were zero; the error is unknown.
  undersampled,      ///< A few samples dominate the estimate.
  too_few_points,    ///< The tail is heavy, and there are fewer points than 2^dimension: it may be that of a peak.
  infinite_variance, ///< The tail of the integrand is so heavy that its variance is infinite.
  not_integrable     ///< The integral is infinite, or converges only conditionally.
};
/// Name of an error bar.
std::string_view name(ErrorBar bar);

/// Exception of integrate() for an integrand that is not finite.
struct NotFinite : Error {
  /// `bad_points` of `of_points` values are not finite. `point` is the first of them and `where` its text in the
  /// message.
  NotFinite(std::uint64_t bad_points, std::uint64_t of_points, std::vector<double> point, std::string_view where);
  std::uint64_t bad,     ///< Number of points with such a value.
      points;            ///< Number of all points.
  std::vector<double> u; ///< The first such point.
};

/// Report to IntegrateOptions::progress.
struct IntegrateProgress {
  Estimate estimate;   ///< Current estimate.
  std::uint64_t calls; ///< Number of evaluations of the integrand so far.
  double seconds;      ///< Wall time so far [s].
};

/// Settings of integrate().
struct IntegrateOptions {
  double rel_error = 1e-3;             ///< Stops when std_error <= rel_error |value| ...
  double abs_error = 0;                ///< ... or when std_error <= abs_error.
  std::uint64_t max_calls = 1'000'000; ///< Upper limit for the number of evaluations of the integrand.
  Method method = Method::automatic;   ///< Integration method.
  std::uint64_t seed = 1;              ///< Seed of all random numbers.
  int threads = 0;                     ///< Number of threads, 0 for all. The result has the same bits for any number.
  double confidence = 0.95;            ///< Confidence level of the interval.
  /// Least number of calls before a run may converge, so that few points do not hide a feature; at most max_calls. The
  /// sequences that give the answer need as many, but at most half of max_calls.
  std::uint64_t min_calls = 10'000;
  /// Number of independent randomisations behind the error of all methods but plain. The last calls of a run may go
  /// into fewer and longer sequences, at least eight, or into more of them.
  std::uint32_t replicates = 16;
  /// Approximate time of one call [ns]. A learned density costs time, which saves calls of a slow integrand.
  double call_ns = 20;
  /// Initial density for vegas, tree and automatic: from an earlier run or from load_density(), for the same or a
  /// similar integrand. The run starts with points from it, and learning continues from it where a refined one
  /// promises less error. A density that does not fit costs calls and does not bias the estimate.
  std::shared_ptr<const AdaptedDensity> density = {};
  /// The last `auxiliary_outputs` outputs affect neither stopping nor adaptation.
  std::size_t auxiliary_outputs = 0;
  std::function<void(const IntegrateProgress&)> progress = {}; ///< Called after each round.
  const std::atomic<bool>* cancel = nullptr;                   ///< Ends the integration when it becomes true.
  /// Who evaluates the integrand in rounds of 65536 calls or more; empty: `threads` of this process. The result has the
  /// same bits for every executor. See MpiRanks, PartRun and JobLog.
  Executor executor = {};
};

/// Diagnostics of one round of a run.
struct IntegrateRound {
  Method method = Method::plain;        ///< Method of the points.
  bool learning = false;                ///< Whether a density was learned from this round, or tested with it.
  std::uint64_t calls = 0;              ///< Evaluations of the whole run so far.
  Estimate estimate = {};               ///< Estimate after this round.
  ErrorBar error_bar = ErrorBar::known; ///< Error bar after this round.
  /// Squared normal deviate of the difference to the final answer, or for stratified to the rounds before. It is part
  /// of Integral::chi2. NaN if both share points.
  double chi2 = 0;
};

/// Integral with its error bar and the history of the run.
struct Integral {
  Estimate estimate; ///< Estimate; std_error is infinite unless error_bar is known.
  /// Two-sided confidence interval: Student t over the replicates, longer on the side of their skewness. It
  /// includes the possible contribution of values larger than all sampled values.
  /// Contains all numbers unless error_bar is known.
  Estimate::Interval interval{};
  ErrorBar error_bar = ErrorBar::known; ///< Reliability of the error.
  bool constant = false;                ///< All values of the integrand were equal.
  double tail_index = 0;                ///< Tail index of the values; infinite unless the tail is heavy.
  /// Number of points where the integrand was infinite. They count as 0, and the variance is infinite.
  std::uint64_t infinite_points = 0;
  std::uint64_t calls = 0;                 ///< Number of evaluations of the integrand.
  double seconds = 0;                      ///< Wall time [s].
  Method method = Method::plain;           ///< Method of the estimate.
  StopReason stop = StopReason::converged; ///< Reason for the end of the run.
  /// Agreement of independent rounds for stratified, vegas and tree; 0 for plain and rqmc. Each difference is converted
  /// from Student's t to a normal deviate and squared. chi2 is near chi2_dof if the rounds agree.
  double chi2 = 0, chi2_dof = 0; ///< Statistic, and its degrees of freedom.
  /// Whether the rounds agree: the probability of a larger chi2 is above 1e-4. If false, the error bar is not reliable.
  bool consistent = true;
  double confidence = 0.95;                ///< Confidence level of the interval.
  std::vector<IntegrateRound> rounds = {}; ///< History of the run.
  /// Learned density, even if the estimate does not use it. Null if none was learned.
  std::shared_ptr<const AdaptedDensity> density = {};

  /// Whether the integral may be infinite or converge only conditionally. Then to_string() does not begin with a value.
  bool may_diverge() const;

  /// Text such as "1.3075 ± 0.00013 (standard error), 95 % in [1.3073, 1.3078]", or the reason for a missing error bar.
  /// Adds a warning if the rounds disagree.
  std::string to_string() const;
};
/// Writes to_string().
std::ostream& operator<<(std::ostream& out, const Integral& r);

/// Several integrals from the same evaluations.
struct VectorIntegral {
  /// One integral per output. Only the fields of the value and its error differ between outputs.
  std::vector<Integral> outputs;
  /// Correlation matrix of the errors, row by row. Estimated from 32 batches of values for plain and from the
  /// replicates for the other methods. Its standard error is about (1 - c^2) / sqrt(R - 1) for R replicates.
  std::vector<double> correlations = {};

  /// Correlation of the errors of outputs i and j.
  double correlation(std::size_t i, std::size_t j) const { return correlations[i * outputs.size() + j]; }
  /// Covariance of the errors of outputs i and j: the squared std_error for i = j. Not finite if an error is unknown.
  double covariance(std::size_t i, std::size_t j) const {
    return correlation(i, j) * outputs[i].estimate.std_error * outputs[j].estimate.std_error;
  }
};

/// f(u, values) fills `values` with one value per output for the point u of the unit cube.
using VectorIntegrand = std::function<void(std::span<const double> u, std::span<double> values)>;

/// Integrand that processes many points at a time. f(points, values) receives the coordinates of each point in
/// sequence. It fills `values` with the outputs of each point in sequence. The result has the same bits as for single
/// points.
struct BatchIntegrand {
  std::function<void(std::span<const double> points, std::span<double> values)> f; ///< Evaluates the points.
  /// Largest number of points of a call, rounded up to a multiple of 256; more than 4096 count as 4096. Large for
  /// functions with a high cost per call.
  std::size_t max_points = 256;
};

/// Integral of f(u) over the unit cube [0,1)^dim. Calls f from several threads at once.
///   plain      : Independent points. Error from the sample variance.
///   stratified : Independent rounds of jittered points, doubling in size. Error from replicates.
///   rqmc       : Independently scrambled Sobol' sequences that double in length, interlaced in one and two dimensions,
///                each with its own smooth map of the axes. Error from replicates.
///   vegas      : Scrambled Sobol' sequences through an ImportanceGrid. Whenever the calls have doubled, the grid may
///                be learned anew from the newest points; new replicates then start, so that no point of the answer
///                has shaped its density. An eighth of the points is uniform, so that no weight exceeds 8. The known
///                integral of the density serves as a control variate, which makes uniform points cheap [OwenZhou00].
///   tree       : vegas with a BoxTree within the grid, for integrands that are no product over the axes.
///   automatic  : rqmc; changes to vegas or tree during the run where that promises the wanted error earlier, and back
///                if it does not keep the promise. Uses plain above 1024 dimensions.
///   error      : std_error and intervals have the coverage measured in docs/accuracy.md. No bar covers a feature that
///                no point met. Equal values converge by the rule of three. No run converges with all values 0, or
///                with infinite variance; error_bar then gives the reason.
///   throws     : Error for an empty f, dim < 1, confidence outside (0,1), or threads < 0. Error for a tolerance that
///                is negative or not finite, or max_calls too small for one round. Error for a density of another
///                dimension or for a method without density, or if all outputs are auxiliary. NotFinite if the
///                integrand is NaN at a point, or infinite on more than a thousandth of the volume. Error if cancelled
///                before the first estimate, and any exception of the integrand, after all threads have stopped.
Integral integrate_unit(const std::function<double(std::span<const double>)>& f, int dim,
                        const IntegrateOptions& options = {});

/// Integrals of `outputs` integrands at once. Converges when all primary outputs have converged.
VectorIntegral integrate_unit(const VectorIntegrand& f, int outputs, int dim, const IntegrateOptions& options = {});

/// Same for an integrand that takes many points at a time.
Integral integrate_unit(const BatchIntegrand& f, int dim, const IntegrateOptions& options = {});
/// Same for several outputs of an integrand that takes many points at a time.
VectorIntegral integrate_unit(const BatchIntegrand& f, int outputs, int dim, const IntegrateOptions& options = {});

/// Replicated randomised quasi-Monte Carlo without a tolerance: `count` points in each of `replicates` randomisations.
Integral integrate_rqmc(const std::function<double(std::span<const double>)>& f, int dim, std::uint64_t count,
                        std::uint32_t replicates = 16, std::uint64_t seed = 1, int threads = 0);

namespace detail {
template <Domain D> typename D::UnitPoint unit_point(std::span<const double> u) {
  using S = typename D::Scalar;
  // A double below 1 may round to 1 as a float.
  const auto coordinate = [](double x) { return std::min(S(x), one_minus_epsilon<S>); };
  if constexpr (D::dim == 1) return coordinate(u[0]);
  else {
    typename D::UnitPoint v;
    if constexpr (D::dim == Eigen::Dynamic) v.resize(static_cast<Eigen::Index>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i) v[static_cast<Eigen::Index>(i)] = coordinate(u[i]);
    return v;
  }
}
template <Domain D> int dimension(const D& domain) {
  if constexpr (D::dim == Eigen::Dynamic) return domain.dimension();
  else return D::dim;
}
} // namespace detail

/// Integral of f over a domain, in the measure of the domain.
template <class F, Domain D>
requires std::invocable<F, typename D::Point> Integral integrate(F&& f, const D& domain,
                                                                 const IntegrateOptions& options = {}) {
  return integrate_unit(
      [&](std::span<const double> u) {
        const auto v = detail::unit_point<D>(u);
        return static_cast<double>(f(domain.from_unit(v))) * static_cast<double>(domain.jacobian(v));
      },
      detail::dimension(domain), options);
}

/// Integral of f over the domain of a warp, importance-sampled by the warp: the mean of f(x) / pdf(x).
template <class F, Warp W>
requires std::invocable<F, PointOf<W>> Integral integrate(F&& f, const W& warp, const IntegrateOptions& options = {}) {
  return integrate_unit(
      [&](std::span<const double> u) {
        const auto x = warp.sample(detail::unit_point<typename W::Domain>(u));
        const double value = static_cast<double>(f(x));
        return value == 0 ? 0.0 : value / static_cast<double>(warp.pdf(x));
      },
      detail::dimension(warp.domain()), options);
}

} // namespace mc
