#pragma once
/// Integration to a wanted error.

#include <mc/core/error.h>
#include <mc/domain/concept.h>
#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/estimate.h>
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

/// How points are placed. `automatic` starts with rqmc, tries what vegas and tree learn when that has not converged by
/// a 16th of the calls, and keeps the best of the three; plain above 1024 dimensions.
enum class Method { automatic, plain, stratified, rqmc, vegas, tree };
std::string_view name(Method method);
/// Throws Error, naming the nearest method, for an unknown name.
Method parse_method(std::string_view name);

/// Why integration ended.
enum class StopReason { converged, max_calls, cancelled };
std::string_view name(StopReason stop);

/// What is known of the error.
enum class ErrorBar {
  known,
  all_zero,     ///< every value was zero: nothing tells how large those are that were not met
  undersampled, ///< few points hold most of the integral, or values beyond those met may: the next may change it all
  infinite_variance ///< the integrand is large on a volume that shrinks so slowly that no error bar holds, see TailIndexEstimator
};
std::string_view name(ErrorBar bar);

/// What integrate() throws for an integrand that is not finite: at so many of so many points, the first of which is u;
/// `where` is that point as text.
struct NotFinite : Error {
  NotFinite(std::uint64_t bad_points, std::uint64_t of_points, std::vector<double> point, std::string_view where);
  std::uint64_t bad, points;
  std::vector<double> u;
};

struct IntegrateProgress {
  Estimate estimate;
  std::uint64_t calls;
  double seconds;
};

struct IntegrateOptions {
  double rel_error = 1e-3;             ///< stop when std_error <= rel_error |value| ...
  double abs_error = 0;                ///< ... or std_error <= abs_error
  std::uint64_t max_calls = 1'000'000; ///< never evaluate the integrand more often
  Method method = Method::automatic;
  std::uint64_t seed = 1;
  int threads = 0;          ///< 0: all of the machine's; the result has the same bits for any number
  double confidence = 0.95; ///< of the interval
  /// Independent randomisations behind the error of stratified, rqmc, vegas and tree. Where a run uses up its calls,
  /// its sequences are in the end more than these, or fewer and longer, whichever leaves less variance; but never fewer
  /// than a third of them, nor than eight, unless fewer were asked for.
  std::uint32_t replicates = 24;
  /// Of an earlier run, or read from a file (see load_density), of this integrand or one like it. Short rounds of
  /// uniform points and of its own try it: where it fits, vegas, tree and automatic take it for what they would have
  /// learned; where it does not, they go on learning from it. As unbiased for any density.
  std::shared_ptr<const AdaptedDensity> density = {};
  /// The last so many outputs need not be accurate: they neither end the run nor say where points go.
  std::size_t auxiliary_outputs = 0;
  std::function<void(const IntegrateProgress&)> progress = {};
  const std::atomic<bool>* cancel = nullptr;
};

/// What a run saw at one point of its way.
struct IntegrateRound {
  Method method = Method::plain; ///< whose points these are
  bool learning = false;         ///< a round that a density was learned from, or measured with
  std::uint64_t calls = 0;       ///< so far, of the whole run
  Estimate estimate = {};
  ErrorBar error_bar = ErrorBar::known;
  /// The square of the normal deviate by which it differs from the answer (of stratified: from the rounds before), as
  /// added to Integral::chi2; not a number where the two share points.
  double chi2 = 0;
};

/// An integral with its error bar and how it was found.
struct Integral {
  Estimate estimate; ///< its std_error is infinite unless error_bar is known
  /// Two-sided, Student t for replicates, longer on the side they are skewed to. Of a learned density it allows for
  /// values larger than all that were met, see OctaveHistogram. All numbers unless error_bar is known.
  Estimate::Interval interval{};
  ErrorBar error_bar = ErrorBar::known;
  double tail_index = 0; ///< of the integrand, see TailIndexEstimator; infinite for a bounded one
  std::uint64_t infinite_points =
      0; ///< points where the integrand was infinite, which count as 0: the variance is infinite
  std::uint64_t calls = 0;
  double seconds = 0;
  Method method = Method::plain; ///< the one picked
  StopReason stop = StopReason::converged;
  /// stratified, vegas and tree: how well independent rounds agree, each difference turned from Student's t into a
  /// normal deviate and squared; near its dof. plain and rqmc: 0
  double chi2 = 0, chi2_dof = 0;
  /// Whether the rounds agree: chi2 is exceeded by chance with probability over 1e-4. False: distrust the error bar.
  bool consistent = true;
  double confidence = 0.95; ///< of the interval
  std::vector<IntegrateRound> rounds = {};
  /// What was learned, whether it was used in the end or not; none where nothing was.
  std::shared_ptr<const AdaptedDensity> density = {};

  /// "1.3075 ± 0.00013 (standard error), 95 % in [1.3073, 1.3078]", or why there is no error bar; and a warning where
  /// the rounds disagree.
  std::string to_string() const;
};
std::ostream& operator<<(std::ostream& out, const Integral& r);

/// Several integrals from the same calls.
struct VectorIntegral {
  std::vector<Integral> outputs; ///< all fields but what is said of an integral and its error are common
  /// Of the errors, row by row; from the values of plain in 32 batches, from the replicates of the other methods: off
  /// by about (1 - c^2) / sqrt(23) for 24 of them.
  std::vector<double> correlations = {};

  double correlation(std::size_t i, std::size_t j) const { return correlations[i * outputs.size() + j]; }
  /// Of the errors: the squared std_error for i = j, not finite where an error is not known.
  double covariance(std::size_t i, std::size_t j) const {
    return correlation(i, j) * outputs[i].estimate.std_error * outputs[j].estimate.std_error;
  }
};

/// f(u, values) fills `values`, one per output, for a point u of the unit cube.
using VectorIntegrand = std::function<void(std::span<const double> u, std::span<double> values)>;

/// Many points at a time, for what is faster in a loop of its own: f(points, values) is given up to 256 points, their
/// coordinates one point after the other, and fills `values` likewise, as many for each point as there are outputs. The
/// result has the same bits as that of one point at a time.
struct BatchIntegrand {
  std::function<void(std::span<const double> points, std::span<double> values)> f;
};

/// The integral over the unit cube of f(u) du, f evaluated at points of [0,1)^dim, from several threads at once.
///   plain      : independent points, error from the sample variance
///   stratified : rounds of jittered grids of doubling size, error from replicates
///   rqmc       : independently scrambled Sobol' sequences that double in length, interlaced in one and two dimensions,
///                error from replicates
///   vegas      : rqmc through an ImportanceGrid learned on a 32nd of the calls, or up to a quarter where those are
///                few, up to a fifth where values are spread widely, and to two fifths where rare large ones may be
///                left to be found; the last round it was learned on is the consistency check. The grid is frozen
///                before the sequences start, so the estimate is unbiased; a ninth of the points are uniform, so that
///                no value exceeds 8 times the integrand's, and the grid's own integral is subtracted, so that they
///                cost little [OwenZhou00]; up to a half where most of the error would be theirs
///   tree       : the same with a BoxTree within the grid, for what is no product of axes
///   automatic  : learns from the points of rqmc that were made anyway, and gives up where rqmc is clearly ahead; else
///                holds the error of vegas and tree, of a third of the replicates, against that of rqmc at the same
///                length
///   error      : without a tolerance, 66 to 71 % of runs lie within 1 std_error of the truth and 93 to 96.5 % within
///                2, for every method over Genz's families [Genz87], and the 95 % intervals of vegas, tree and
///                automatic hold it in 95 to 97 %; with and without a tolerance, 93 to 97 % of the
///                95 % intervals of rqmc hold the truth on steps, kinks, shells and singularities of finite variance at
///                random places. No error is 0 because replicates agree: what they could not see has a bound. None
///                converges on fewer than 128 points of each replicate, nor where every value was 0, or the variance is
///                infinite, as error_bar says
///   throws     : Error for an empty f, dim < 1, a tolerance that is negative or not finite, max_calls too small for
///                one round, confidence outside (0,1), threads < 0, a density of another dimension or for a method that
///                has none, no output that is not watched; what the integrand throws, after all threads have
///                stopped; NotFinite for an integrand that is not a number somewhere, or infinite on more than a
///                thousandth of the volume; and when cancelled before anything was estimated
Integral integrate_unit(const std::function<double(std::span<const double>)>& f, int dim,
                        const IntegrateOptions& options = {});

/// The same for `outputs` integrands at once; converged when each of them is.
VectorIntegral integrate_unit(const VectorIntegrand& f, int outputs, int dim, const IntegrateOptions& options = {});

Integral integrate_unit(const BatchIntegrand& f, int dim, const IntegrateOptions& options = {});
VectorIntegral integrate_unit(const BatchIntegrand& f, int outputs, int dim, const IntegrateOptions& options = {});

/// Replicated randomised quasi-Monte Carlo with `count` points in each of `replicates` randomisations, without a
/// tolerance.
Integral integrate_rqmc(const std::function<double(std::span<const double>)>& f, int dim, std::uint64_t count,
                        std::uint32_t replicates = 24, std::uint64_t seed = 1, int threads = 0);

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

/// The integral of f over a domain, in the domain's measure.
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

/// The integral of f over the domain of a warp, importance-sampled by the warp: the mean of f(x) / pdf(x).
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
