#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/points/discrepancy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace mc {

namespace {

// 1 / n^2 times the sum of Product_k kernel(x_k, y_k) over all ordered pairs of points, including pairs of a point with
// itself.
template <class Kernel> double mean_over_pairs(PointList p, Kernel kernel) {
  CompensatedSum pairs, own;
  for (std::size_t i = 0; i < p.size(); ++i) {
    double row = 0; // needs no compensation: its terms have one sign
    for (std::size_t j = 0; j < i; ++j) {
      double product = 1;
      for (std::size_t k = 0; k < p.dim; ++k) product *= kernel(p[i][k], p[j][k]);
      row += product;
    }
    pairs.add(row);
    double product = 1;
    for (std::size_t k = 0; k < p.dim; ++k) product *= kernel(p[i][k], p[i][k]);
    own.add(product);
  }
  const double n = static_cast<double>(p.size());
  return (2 * pairs.value() + own.value()) / (n * n);
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

double root(double square) { return std::sqrt(std::max(square, 0.0)); }

// Distance on a circle of length 1.
double around(double x, double y) {
  const double d = std::abs(x - y);
  return std::min(d, 1 - d);
}

} // namespace

void require_unit_points(PointList p) {
  require(p.dim >= 1 && !p.values.empty() && p.values.size() % p.dim == 0,
          "points: {} numbers are no points of {} dimensions", p.values.size(), p.dim);
  for (std::size_t i = 0; i < p.values.size(); ++i)
    require(p.values[i] >= 0 && p.values[i] < 1, "points: coordinate {} of point {} is {}; it must lie in [0, 1)",
            i % p.dim, i / p.dim, p.values[i]);
}

double l2_star_discrepancy(PointList p) {
  require_unit_points(p);
  const double d = static_cast<double>(p.dim);
  const double cross = mean_over_points(p, [](double x) { return (1 - x) * (1 + x); });
  const double pairs = mean_over_pairs(p, [](double x, double y) { return 1 - std::max(x, y); });
  return root(std::pow(3, -d) - std::pow(2, 1 - d) * cross + pairs);
}

double periodic_l2_discrepancy(PointList p) {
  require_unit_points(p);
  const double pairs = mean_over_pairs(p, [](double x, double y) {
    const double t = around(x, y);
    return 0.5 - t * (1 - t);
  });
  return root(pairs - std::pow(3, -static_cast<double>(p.dim)));
}

double wraparound_discrepancy(PointList p) {
  require_unit_points(p);
  const double pairs = mean_over_pairs(p, [](double x, double y) {
    const double t = around(x, y);
    return 1.5 - t * (1 - t);
  });
  return root(pairs - std::pow(4.0 / 3, static_cast<double>(p.dim)));
}

double centered_discrepancy(PointList p) {
  require_unit_points(p);
  const auto off = [](double x) { return std::abs(x - 0.5); };
  const double cross = mean_over_points(p, [&](double x) { return 1 + 0.5 * off(x) * (1 - off(x)); });
  const double pairs =
      mean_over_pairs(p, [&](double x, double y) { return 1 + 0.5 * off(x) + 0.5 * off(y) - 0.5 * std::abs(x - y); });
  return root(std::pow(13.0 / 12, static_cast<double>(p.dim)) - 2 * cross + pairs);
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
