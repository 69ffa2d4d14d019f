#include <integrands/box_map.h>
#include <integrate/histogram.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/estimate/values/histogram.h>
#include <mc/estimate/values/quantiles.h>
#include <mc/random/uniform.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace carlo {

namespace {

std::string bin_name(const std::string& observable, double lo, double hi) {
  if (std::isinf(lo)) return fmt::format("{} < {:.4g}", observable, hi);
  if (std::isinf(hi)) return fmt::format("{} >= {:.4g}", observable, lo);
  return fmt::format("{} in [{:.4g}, {:.4g})", observable, lo, hi);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

double number(std::string_view word) {
  const std::optional<double> value = mc::parse_double(word);
  mc::require(value.has_value(), "--histogram: '{}' is not a number", word);
  return *value;
}

struct Request {
  std::string observable;
  std::optional<std::pair<double, double>> range;
  std::size_t bins;
};

Request parse(const std::string& option) {
  const std::size_t equals = option.rfind('=');
  mc::require(equals != std::string::npos && equals > 0,
              "--histogram '{}' must be AXIS=BINS or AXIS=LO:HI:BINS, e.g. x=20 or r=0:2:20", option);
  const std::vector<std::string_view> words = mc::split(std::string_view(option).substr(equals + 1), ':');
  mc::require(words.size() == 1 || words.size() == 3, "--histogram '{}' must be AXIS=BINS or AXIS=LO:HI:BINS", option);
  const double count = number(words.back());
  mc::require(count >= 2 && count <= 1000 && count == std::floor(count),
              "--histogram: {} bins; a whole number between 2 and 1000 is needed", count);
  Request r{std::string(mc::trimmed(std::string_view(option).substr(0, equals))), {}, static_cast<std::size_t>(count)};
  if (words.size() == 3) {
    r.range = {number(words[0]), number(words[1])};
    mc::require(std::isfinite(r.range->first) && std::isfinite(r.range->second) && r.range->first < r.range->second,
                "--histogram '{}': LO < HI is needed, both finite", option);
  }
  return r;
}

// Bins by size: powers of 2 below the largest of 4096 values of the integrand times the volume of the domain.
Histogram bins_by_value(const UnitCubeIntegral& e, double volume, std::size_t count, std::uint64_t seed) {
  const double top_quantile[] = {1 - 1e-9};
  const double largest = mc::quantiles([&](std::span<const double> u) { return std::abs(e.f(u)); }, e.dim, top_quantile,
                                       {.calls = 4096, .seed = seed})
                             .front()
                             .value;
  mc::require(largest > 0, "--histogram: the integrand was 0 at 4096 points; there is no size to start from");
  const double top = std::ldexp(volume, std::ilogb(largest / volume));
  Histogram all{{}, [=, f = e.f](std::span<const double> u, std::span<double> values) {
                  std::fill(values.begin(), values.end(), 0.0);
                  values[0] = f(u);
                  values[1 + mc::octave_bin(top, values[0], count)] = values[0];
                }};
  for (std::size_t k = 0; k < count; ++k) {
    const double lo = k + 1 < count ? std::ldexp(top / volume, -static_cast<int>(k)) : 0.0;
    const double hi = k > 0 ? std::ldexp(top / volume, 1 - static_cast<int>(k)) : infinity;
    all.bins.push_back({bin_name("|value|", lo, hi), lo, hi, {}});
  }
  return all;
}

// Least and greatest finite value of an expression at 4096 points.
std::pair<double, double> extremes(const ExpressionIntegral& integral, std::size_t expression,
                                   const std::string& observable, std::uint64_t seed) {
  double lo = infinity, hi = -infinity;
  std::vector<double> u(static_cast<std::size_t>(integral.dim()));
  for (std::uint64_t i = 0; i < 4096; ++i) {
    for (std::size_t d = 0; d < u.size(); ++d) u[d] = mc::hash_uniform<double>(seed, i, d);
    integral.visit(u, [&](double, const ExpressionProgram::Frame& frame) {
      const double x = frame.evaluate(expression);
      if (!std::isfinite(x)) return;
      lo = std::min(lo, x);
      hi = std::max(hi, x);
    });
  }
  mc::require(lo < hi, "--histogram: '{}' had no two values at 4096 points; give its range: '{}=LO:HI:BINS'",
              observable, observable);
  return {lo, hi};
}

// Edges of bins of equal length, with one bin on each side of the range.
std::vector<double> edges_between(double lo, double hi, std::size_t bins) {
  std::vector<double> edges = {-infinity};
  for (std::size_t k = 0; k <= bins; ++k)
    edges.push_back(lo + (hi - lo) * (static_cast<double>(k) / static_cast<double>(bins)));
  edges.push_back(infinity);
  return edges;
}

// The bin of x between ascending edges; for NaN the number of bins.
std::size_t bin_of(const std::vector<double>& edges, double x) {
  if (std::isnan(x)) return edges.size() - 1;
  const auto above = std::upper_bound(edges.begin(), edges.end(), x);
  const auto k = static_cast<std::size_t>(above - edges.begin());
  return std::clamp<std::size_t>(k, 1, edges.size() - 1) - 1; // rounding may carry a point beyond the outer edges
}

std::vector<HistogramBin> named_bins(const std::string& name, const std::vector<double>& edges) {
  std::vector<HistogramBin> bins;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    bins.push_back({bin_name(name, edges[k], edges[k + 1]), edges[k], edges[k + 1], {}});
  return bins;
}

// Edges of bins of equal probability in the cube; their lengths grow outward on an infinite side.
template <class ValueAt> std::vector<double> edges_in_cube(std::size_t bins, ValueAt value_at) {
  std::vector<double> edges;
  for (std::size_t k = 0; k <= bins; ++k) edges.push_back(value_at(static_cast<double>(k) / static_cast<double>(bins)));
  return edges;
}

Histogram of_variable(const UnitCubeIntegral& e, const Request& r) {
  const std::vector<VariableBounds> bounds = e.bounds.empty() ? unit_cube_bounds(e.dim) : e.bounds;
  const auto found =
      std::find_if(bounds.begin(), bounds.end(), [&](const VariableBounds& s) { return s.name == r.observable; });
  mc::require(found != bounds.end(), "--histogram: there is no variable '{}'; use one of {} to {}, or value",
              r.observable, bounds.front().name, bounds.back().name);
  const auto axis = static_cast<std::size_t>(found - bounds.begin());
  const VariableBounds& side = *found;
  const std::vector<double> edges = r.range ? edges_between(r.range->first, r.range->second, r.bins)
                                            : edges_in_cube(r.bins, [&](double u) { return map_to_bounds(side, u).x; });
  return {named_bins(r.observable, edges),
          [=, f = e.f](std::span<const double> u, std::span<double> values) {
            std::fill(values.begin(), values.end(), 0.0);
            values[0] = f(u);
            values[1 + bin_of(edges, map_to_bounds(side, u[axis]).x)] = values[0];
          },
          r.range.has_value()};
}

Histogram of_expression(const std::shared_ptr<ExpressionIntegral>& integral, const Request& r, std::uint64_t seed) {
  const std::size_t observable =
      mc::with_context("--histogram", [&] { return integral->add_expression(r.observable); });
  std::vector<double> edges;
  const bool has_outside = r.range || !integral->value_at(r.observable, 0.5);
  if (!has_outside) edges = edges_in_cube(r.bins, [&](double u) { return *integral->value_at(r.observable, u); });
  else {
    const auto [lo, hi] = r.range ? *r.range : extremes(*integral, observable, r.observable, seed);
    edges = edges_between(lo, hi, r.bins);
  }
  return {named_bins(r.observable, edges),
          [=](std::span<const double> u, std::span<double> values) {
            std::fill(values.begin(), values.end(), 0.0);
            integral->visit(u, [&](double weight, const ExpressionProgram::Frame& frame) {
              const double part = weight * integral->value(frame, 0);
              values[0] += part;
              const std::size_t bin = bin_of(edges, frame.evaluate(observable));
              if (bin + 1 < edges.size()) values[1 + bin] += part;
            });
          },
          has_outside};
}

} // namespace

Histogram make_histogram(const std::string& option, const IntegrandSet& set, std::uint64_t seed) {
  const Request r = parse(option);
  const bool by_value = r.observable == "value" && !r.range && !(set.expression && set.expression->has_name("value"));
  if (!by_value)
    return set.expression ? of_expression(set.expression, r, seed) : of_variable(set.integrands.front(), r);
  return bins_by_value(set.integrands.front(), measure_of(set, "--histogram"), r.bins, seed);
}

mc::VectorIntegral integrate(const Histogram& histogram, int dim, mc::IntegrateOptions options) {
  options.auxiliary_outputs = histogram.bins.size();
  return mc::integrate_unit(histogram.f, static_cast<int>(1 + histogram.bins.size()), dim, options);
}

} // namespace carlo
