#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/points/discrepancy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace mc {

namespace {

// For each kernel, 1 / n^2 times the sum of Product_k kernel(x_k, y_k) over all ordered pairs of points. They include
// pairs of a point with itself.
template <class... Kernel> std::array<double, sizeof...(Kernel)> means_over_pairs(PointList p, Kernel... kernel) {
  constexpr std::size_t count = sizeof...(Kernel);
  using Values = std::array<double, count>;
  const auto products = [&](const double* x, const double* y) {
    Values product;
    product.fill(1);
    for (std::size_t k = 0; k < p.dim; ++k) {
      const Values factors = {kernel(x[k], y[k])...};
      for (std::size_t m = 0; m < count; ++m) product[m] *= factors[m];
    }
    return product;
  };
  std::array<CompensatedSum, count> pairs, own;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Values row{}; // needs no compensation: its terms have one sign
    for (std::size_t j = 0; j < i; ++j) {
      const Values product = products(p[i], p[j]);
      for (std::size_t m = 0; m < count; ++m) row[m] += product[m];
    }
    const Values product = products(p[i], p[i]);
    for (std::size_t m = 0; m < count; ++m) {
      pairs[m].add(row[m]);
      own[m].add(product[m]);
    }
  }
  const double n = static_cast<double>(p.size());
  Values means;
  for (std::size_t m = 0; m < count; ++m) means[m] = (2 * pairs[m].value() + own[m].value()) / (n * n);
  return means;
}

template <class Factor> double mean_over_points(PointList p, Factor factor) {
  CompensatedSum sum;
  for (std::size_t i = 0; i < p.size(); ++i) {
    double product = 1;
    for (std::size_t k = 0; k < p.dim; ++k) product *= factor(p[i][k]);
    sum.add(product);
  }
  return sum.value() / static_cast<double>(p.size());
}

// Sums of squares that overflow are NaN here.
double root(double square) {
  return std::isnan(square) ? std::numeric_limits<double>::infinity() : std::sqrt(std::max(square, 0.0));
}

// Distance on a circle of length 1.
double around(double x, double y) {
  const double d = std::abs(x - y);
  return std::min(d, 1 - d);
}

double off(double x) { return std::abs(x - 0.5); } // distance from the centre

// The part of a squared discrepancy that is no mean over pairs.
double star_rest(PointList p) {
  const double d = static_cast<double>(p.dim);
  const double cross = mean_over_points(p, [](double x) { return (1 - x) * (1 + x); });
  return std::pow(3, -d) - std::pow(2, 1 - d) * cross;
}
double periodic_rest(PointList p) { return -std::pow(3, -static_cast<double>(p.dim)); }
double wraparound_rest(PointList p) { return -std::pow(4.0 / 3, static_cast<double>(p.dim)); }
double centered_rest(PointList p) {
  const double cross = mean_over_points(p, [](double x) { return 1 + 0.5 * off(x) * (1 - off(x)); });
  return std::pow(13.0 / 12, static_cast<double>(p.dim)) - 2 * cross;
}
double mixture_rest(PointList p) {
  const double cross = mean_over_points(p, [](double x) { return 5.0 / 3 - 0.25 * off(x) * (1 + off(x)); });
  return std::pow(19.0 / 12, static_cast<double>(p.dim)) - 2 * cross;
}

constexpr auto star_kernel = [](double x, double y) { return 1 - std::max(x, y); };
constexpr auto periodic_kernel = [](double x, double y) {
  const double t = around(x, y);
  return 0.5 - t * (1 - t);
};
constexpr auto wraparound_kernel = [](double x, double y) {
  const double t = around(x, y);
  return 1.5 - t * (1 - t);
};
constexpr auto centered_kernel = [](double x, double y) {
  return 1 + 0.5 * off(x) + 0.5 * off(y) - 0.5 * std::abs(x - y);
};
constexpr auto mixture_kernel = [](double x, double y) {
  const double t = std::abs(x - y);
  return 15.0 / 8 - 0.25 * (off(x) + off(y)) - 0.75 * t + 0.5 * t * t;
};

template <class Kernel> double discrepancy(PointList p, double (*rest)(PointList), Kernel kernel) {
  require_unit_points(p);
  return root(rest(p) + means_over_pairs(p, kernel)[0]);
}

} // namespace

void require_unit_points(PointList p) {
  require(p.dim >= 1 && !p.values.empty() && p.values.size() % p.dim == 0,
          "points: {} numbers are no points of {} dimensions", p.values.size(), p.dim);
  for (std::size_t i = 0; i < p.values.size(); ++i)
    require(p.values[i] >= 0 && p.values[i] < 1, "points: coordinate {} of point {} is {}; it must lie in [0, 1)",
            i % p.dim, i / p.dim, p.values[i]);
}

double l2_star_discrepancy(PointList p) { return discrepancy(p, star_rest, star_kernel); }
double periodic_l2_discrepancy(PointList p) { return discrepancy(p, periodic_rest, periodic_kernel); }
double wraparound_discrepancy(PointList p) { return discrepancy(p, wraparound_rest, wraparound_kernel); }
double centered_discrepancy(PointList p) { return discrepancy(p, centered_rest, centered_kernel); }
double mixture_discrepancy(PointList p) { return discrepancy(p, mixture_rest, mixture_kernel); }

L2Discrepancies l2_discrepancies(PointList p) {
  require_unit_points(p);
  const auto [star, periodic, centered, wraparound, mixture] =
      means_over_pairs(p, star_kernel, periodic_kernel, centered_kernel, wraparound_kernel, mixture_kernel);
  return {root(star_rest(p) + star), root(periodic_rest(p) + periodic), root(centered_rest(p) + centered),
          root(wraparound_rest(p) + wraparound), root(mixture_rest(p) + mixture)};
}

L2Discrepancies random_l2_discrepancies(double count, int dim) {
  const auto rms = [&](double a, double b) { return std::sqrt((std::pow(a, dim) - std::pow(b, dim)) / count); };
  return {rms(0.5, 1.0 / 3), rms(0.5, 1.0 / 3), rms(1.25, 13.0 / 12), rms(1.5, 4.0 / 3), rms(1.75, 19.0 / 12)};
}

double random_mean_square(double count, int dim) { return (std::pow(2, -dim) - std::pow(3, -dim)) / count; }

// The count in a cell cut by the box has variance s (1 - s), where s is the share of the cell inside the box. Along one
// axis, the mean of s over all boxes and cells is 1/2, and the mean of its square is 1/2 - 1 / (6 m).
double jittered_star_mean_square(double count, int dim) {
  const double m = std::pow(count, 1.0 / dim);
  return (std::pow(0.5, dim) - std::pow(0.5 - 1 / (6 * m), dim)) / count;
}

double jittered_periodic_mean_square(double count, int dim) {
  const double m = std::pow(count, 1.0 / dim);
  return (std::pow(0.5, dim) - std::pow(0.5 - 1 / (3 * m) + 1 / (6 * m * m), dim)) / count;
}

// Visits the points after each point in cyclic order of the first axis, until the distance along that axis alone is too
// large.
SmallestDistance smallest_distance(PointList p) {
  require_unit_points(p);
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a][0] < p[b][0]; });
  double plain = std::numeric_limits<double>::infinity(), periodic = plain;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t step = 1; step < p.size(); ++step) {
      const std::size_t j = i + step < p.size() ? i + step : i + step - p.size();
      const double *a = p[order[i]], *b = p[order[j]], gap = i < j ? b[0] - a[0] : 1 - (a[0] - b[0]);
      if (gap * gap >= plain) break; // the periodic distance is at most the plain distance
      double wrapped = 0;
      for (std::size_t k = 0; k < p.dim && wrapped < plain; ++k) {
        const double t = around(a[k], b[k]);
        wrapped += t * t;
      }
      if (wrapped >= plain) continue; // the plain distance is at least the periodic distance
      periodic = std::min(periodic, wrapped);
      double straight = 0;
      for (std::size_t k = 0; k < p.dim; ++k) straight += (a[k] - b[k]) * (a[k] - b[k]);
      plain = std::min(plain, straight);
    }
  return {std::sqrt(plain), std::sqrt(periodic)};
}

} // namespace mc
