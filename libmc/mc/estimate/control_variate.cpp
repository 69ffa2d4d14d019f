#include <mc/core/error.h>
#include <mc/estimate/control_variate.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Uses arrays of the standard library, because Eigen's allocation depends on the instruction set of the translation
// unit.
namespace mc {

namespace {

// Rotates axes i and j of the symmetric matrix a, and rows i and j of v, so that a(i, j) becomes 0.
void rotate(std::vector<double>& a, std::vector<double>& v, std::size_t n, std::size_t i, std::size_t j) {
  const double theta = (a[j * n + j] - a[i * n + i]) / (2 * a[i * n + j]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  const auto turn_pair = [&](double& x, double& y) {
    const double old_x = x;
    x = c * x - s * y;
    y = s * old_x + c * y;
  };
  for (std::size_t k = 0; k < n; ++k) turn_pair(a[k * n + i], a[k * n + j]);
  for (std::size_t k = 0; k < n; ++k) turn_pair(a[i * n + k], a[j * n + k]);
  for (std::size_t k = 0; k < n; ++k) turn_pair(v[i * n + k], v[j * n + k]);
}

// Shortest x with minimal |a x - b| for a correlation matrix a. Treats eigenvalues up to `noise` times the largest as
// 0. Finds eigenvectors by cyclic Jacobi, with an absolute error of a few epsilon. A few sweeps suffice for any size.
std::vector<double> shortest_solution(std::vector<double> a, const std::vector<double>& b, double noise) {
  const std::size_t n = b.size();
  std::vector<double> v(n * n); // an eigenvector per row
  for (std::size_t i = 0; i < n; ++i) v[i * n + i] = 1;
  bool turned = true;
  for (int sweep = 0; turned && sweep < 50; ++sweep) {
    turned = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        if (std::abs(a[i * n + j]) <= std::numeric_limits<double>::epsilon()) continue;
        rotate(a, v, n, i, j);
        turned = true;
      }
  }
  double largest = a[0]; // eigenvalue
  for (std::size_t i = 1; i < n; ++i) largest = std::max(largest, a[i * n + i]);
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (a[i * n + i] <= noise * largest) continue;
    double along = 0;
    for (std::size_t k = 0; k < n; ++k) along += v[i * n + k] * b[k];
    for (std::size_t k = 0; k < n; ++k) x[k] += along / a[i * n + i] * v[i * n + k];
  }
  return x;
}

} // namespace

ControlVariates::ControlVariates(std::span<const double> means)
    : means_(means.begin(), means.end()), mean_(means.size() + 1), scatter_(mean_.size() * mean_.size()) {
  require(!means.empty(), "ControlVariates: no controls; at least one is needed");
  for (std::size_t j = 0; j < means.size(); ++j)
    require(std::isfinite(means[j]), "ControlVariates: means[{}] = {} is not finite", j, means[j]);
}

void ControlVariates::add(double f, std::span<const double> g, std::uint64_t index) {
  MC_ASSERT(g.size() == means_.size());
  const std::size_t n = mean_.size();
  std::vector<double> delta(n);
  for (std::size_t i = 0; i < n; ++i) delta[i] = (i == 0 ? f : g[i - 1] - means_[i - 1]) - mean_[i];
  if (!std::all_of(delta.begin(), delta.end(), [](double d) { return std::isfinite(d); })) [[unlikely]] {
    if (non_finite_++ == 0) first_non_finite_ = index;
    return;
  }
  const double count = static_cast<double>(++count_);
  for (std::size_t i = 0; i < n; ++i) mean_[i] += delta[i] / count;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) scatter_[i * n + j] += delta[i] * delta[j] * ((count - 1) / count);
}

void ControlVariates::merge(const ControlVariates& other) {
  require(means_ == other.means_,
          "ControlVariates: merge of {} and {} controls of different means; they must be the same", means_.size(),
          other.means_.size());
  if (other.non_finite_ > 0 && non_finite_ == 0) first_non_finite_ = other.first_non_finite_;
  non_finite_ += other.non_finite_;
  if (other.count_ == 0) return;
  const double a = static_cast<double>(count_), b = static_cast<double>(other.count_), total = a + b;
  const std::size_t n = mean_.size();
  std::vector<double> delta(n);
  for (std::size_t i = 0; i < n; ++i) delta[i] = other.mean_[i] - mean_[i];
  for (std::size_t i = 0; i < n; ++i) mean_[i] += delta[i] * (b / total);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      scatter_[i * n + j] += other.scatter_[i * n + j] + delta[i] * delta[j] * (a * b / total);
  count_ += other.count_;
}

void ControlVariates::require_enough() const {
  require(non_finite_ == 0, "ControlVariates: {} of {} values are not finite, the first at index {}", non_finite_,
          non_finite_ + count_, first_non_finite_);
  require(count_ >= 2, "ControlVariates: {} values; at least 2 are needed", count_);
}

std::vector<double> ControlVariates::coefficients() const {
  require_enough();
  // Works in units of the standard deviations, so that the rank does not depend on the scale of the controls.
  const std::size_t n = mean_.size(), k = means_.size();
  std::vector<double> units(k), correlations(k * k), with_f(k);
  for (std::size_t i = 0; i < k; ++i) {
    const double deviation = std::sqrt(scatter_[(i + 1) * n + i + 1]);
    units[i] = deviation > 0 ? deviation : 1;
  }
  for (std::size_t i = 0; i < k; ++i) {
    with_f[i] = scatter_[i + 1] / units[i];
    for (std::size_t j = 0; j < k; ++j) correlations[i * k + j] = scatter_[(i + 1) * n + j + 1] / units[i] / units[j];
  }
  // The rounding error of a sum of `count` products is about epsilon sqrt(count).
  const double noise =
      static_cast<double>(k) * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(count_));
  std::vector<double> beta = shortest_solution(correlations, with_f, noise);
  for (std::size_t i = 0; i < k; ++i) beta[i] /= units[i];
  return beta;
}

Estimate ControlVariates::estimate(std::span<const double> beta) const {
  require_enough();
  require(
      beta.size() == means_.size() && std::all_of(beta.begin(), beta.end(), [](double b) { return std::isfinite(b); }),
      "ControlVariates: {} coefficients for {} controls; as many finite ones are needed", beta.size(), means_.size());
  // The variance of the combination c . (f, g) with c = (1, -beta) is a quadratic form of the scatter.
  const std::size_t size = mean_.size();
  std::vector<double> c(size, 1.0);
  std::transform(beta.begin(), beta.end(), c.begin() + 1, [](double b) { return -b; });
  double value = 0, square = 0;
  for (std::size_t i = 0; i < size; ++i) {
    double row = 0;
    for (std::size_t j = 0; j < size; ++j) row += scatter_[i * size + j] * c[j];
    square += c[i] * row;
    value += c[i] * mean_[i];
  }
  const double n = static_cast<double>(count_), variance = std::max(0.0, square) / (n - 1);
  return Estimate::from_student_t(value, std::sqrt(variance / n), n - 1, count_);
}

Estimate cross_fitted_estimate(const ControlVariates& a, const ControlVariates& b) {
  require(std::ranges::equal(a.means(), b.means()),
          "cross_fitted_estimate: the means of the controls differ between the halves; they must be the same");
  const Estimate first = a.estimate(b.coefficients()), second = b.estimate(a.coefficients());
  const double n = static_cast<double>(first.count + second.count), share = static_cast<double>(first.count) / n;
  return Estimate::from_student_t(
      share * first.value + (1 - share) * second.value,
      std::hypot(share * first.unwidened_std_error(), (1 - share) * second.unwidened_std_error()),
      first.dof + second.dof, first.count + second.count);
}

} // namespace mc
