#pragma once
/// Integration to a wanted error.

#include <mc/domain/concept.h>
#include <mc/estimate/estimate.h>
#include <mc/warp/concept.h>

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// How points are placed. `automatic` picks rqmc up to 1024 dimensions, plain above.
enum class Method { automatic, plain, stratified, rqmc };
std::string_view name(Method method);
/// Throws Error, naming the nearest method, for an unknown name.
Method method_from(std::string_view name);

/// Why integration ended.
enum class Stop { converged, max_calls, cancelled };
std::string_view name(Stop stop);

struct IntegrateProgress {
  Estimate estimate;
  std::uint64_t calls;
  double seconds;
};

struct IntegrateOptions {
  double rel_error = 1e-3;              ///< stop when std_error <= rel_error |value| ...
  double abs_error = 0;                 ///< ... or std_error <= abs_error
  std::uint64_t max_calls = 1'000'000;  ///< never evaluate the integrand more often
  Method method = Method::automatic;
  std::uint64_t seed = 1;
  int threads = 0;                      ///< 0: all of the machine's; the result has the same bits for any number
  double confidence = 0.95;             ///< of the interval
  std::uint32_t replicates = 16;        ///< independent randomisations behind the error of stratified and rqmc
  std::function<void(const IntegrateProgress&)> progress = {};
  const std::atomic<bool>* cancel = nullptr;
};

/// An integral with its error bar and how it was come by.
struct Integral {
  Estimate estimate;
  Estimate::Interval interval{};        ///< two-sided, Student t for replicates
  std::uint64_t calls = 0;
  double seconds = 0;
  Method method = Method::plain;        ///< the one picked
  Stop stop = Stop::converged;
  double chi2 = 0, chi2_dof = 0;        ///< stratified: agreement of the rounds, near its dof when they agree; else 0
};

/// The integral over the unit cube of f(u) du, f evaluated at points of [0,1)^dim.
///   method : plain: independent points, error from the sample variance. rqmc: independently scrambled Sobol' sequences that
///            double in length; stratified: rounds of jittered grids of doubling size; error from the replicates
///   throws : Error for dim < 1, a tolerance that is negative or NaN, both tolerances 0 without a call limit, max_calls too small
///            for one round, confidence outside (0,1); what the integrand throws, after all threads have stopped; and for an
///            integrand that is not finite, with the point where it first was
Integral integrate_unit(const std::function<double(std::span<const double>)>& f, int dim, const IntegrateOptions& options = {});

/// Replicated randomised quasi-Monte Carlo with `count` points in each of `replicates` randomisations, without a tolerance.
Integral integrate_rqmc(const std::function<double(std::span<const double>)>& f, int dim, std::uint64_t count, std::uint32_t replicates = 16,
                        std::uint64_t seed = 1, int threads = 0);

namespace detail {
template <Domain D> typename D::UnitPoint unit_point(std::span<const double> u) {
  using S = typename D::Scalar;
  if constexpr (D::dim == 1) return S(u[0]);
  else {
    typename D::UnitPoint v;
    if constexpr (D::dim == Eigen::Dynamic) v.resize(static_cast<Eigen::Index>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i) v[static_cast<Eigen::Index>(i)] = S(u[i]);
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
  requires std::invocable<F, typename D::Point>
Integral integrate(F&& f, const D& domain, const IntegrateOptions& options = {}) {
  return integrate_unit(
      [&](std::span<const double> u) {
        const auto v = detail::unit_point<D>(u);
        return static_cast<double>(f(domain.from_unit(v))) * static_cast<double>(domain.jacobian(v));
      },
      detail::dimension(domain), options);
}

/// The integral of f over the domain of a warp, importance-sampled by the warp: the mean of f(x) / pdf(x).
template <class F, Warp W>
  requires std::invocable<F, PointOf<W>>
Integral integrate(F&& f, const W& warp, const IntegrateOptions& options = {}) {
  return integrate_unit(
      [&](std::span<const double> u) {
        const auto x = warp.sample(detail::unit_point<typename W::Domain>(u));
        const double value = static_cast<double>(f(x));
        return value == 0 ? 0.0 : value / static_cast<double>(warp.pdf(x));
      },
      detail::dimension(warp.domain()), options);
}

} // namespace mc
