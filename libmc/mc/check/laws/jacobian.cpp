// Jacobian law: |det d sample / d u| pdf = 1, by central differences. Over 50 digits if the distribution has an oracle,
// else in double.

#include <mc/check/laws/law.h>

namespace mc {
namespace {

template <class T> using Matrix = PerAxis<PerAxis<T>>;

// Returns the determinant of the leading n rows and columns, by elimination with pivots.
template <class T> T determinant(Matrix<T> j, std::size_t n) {
  using std::abs;
  T product(1);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(j[i][k]) > abs(j[pivot][k])) pivot = i;
    if (j[pivot][k] == T(0)) return T(0);
    if (pivot != k) {
      std::swap(j[pivot], j[k]);
      product = -product;
    }
    product *= j[k][k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const T factor = j[i][k] / j[k][k];
      for (std::size_t c = k; c < n; ++c) j[i][c] -= factor * j[k][c];
    }
  }
  return product;
}

Check oracle_jacobian(const AnyDistribution& s, const LawOptions& options) {
  const Oracle h(1e-20);
  const auto n = static_cast<std::size_t>(s.domain.dim);
  WorstError error("|det| pdf = 1", 1e-20, Fault::jacobian);
  Pcg random(options.statistics.seed, 12);
  for (std::uint64_t k = 0; k < options.points / 4; ++k) {
    const OracleDistribution::Point u = oracle_uniforms(s, random);
    Matrix<Oracle> j;
    bool fails = false;
    for (std::size_t axis = 0; axis < n && !fails; ++axis) {
      OracleDistribution::Point ahead = u, behind = u;
      ahead[axis] += h;
      behind[axis] -= h;
      const auto a = s.oracle->sample(ahead), b = s.oracle->sample(behind);
      fails = !a || !b;
      if (fails) break;
      const OracleDistribution::Point va = s.oracle->to_chart(*a).v, vb = s.oracle->to_chart(*b).v;
      for (std::size_t i = 0; i < n; ++i) j[i][axis] = (va[i] - vb[i]) / (2 * h);
    }
    const auto x = s.oracle->sample(u);
    if (fails || !x) continue;
    const Oracle density = s.oracle->pdf(*x) * s.oracle->to_chart(*x).jacobian;
    const double off = std::abs(static_cast<double>(abs(determinant(j, n) * density) - 1));
    error.note(off, [&] {
      PerAxis<double> c{};
      for (std::size_t i = 0; i < n; ++i) c[i] = static_cast<double>(u[i]);
      return fmt::format("|det d sample / d u| pdf differs from 1 by {:.3g}, at u = {}", off,
                         format_numbers({c.data(), n}, 17));
    });
  }
  return error.check();
}

// Returns d v / d u at u by differences of step h; no value if sample fails.
std::optional<Matrix<double>> derivative(const AnyDistribution& s, const AnyDistribution::Uniforms& u, double h) {
  const auto n = static_cast<std::size_t>(s.domain.dim);
  Matrix<double> j{};
  for (std::size_t axis = 0; axis < n; ++axis) {
    AnyDistribution::Uniforms ahead = u, behind = u;
    ahead[axis] += h;
    behind[axis] -= h;
    const auto a = s.sample(ahead), b = s.sample(behind);
    if (!a || !b) return {};
    const AnyDomain::Coordinates va = s.domain.to_unit(a->x), vb = s.domain.to_unit(b->x);
    for (std::size_t i = 0; i < n; ++i) j[i][axis] = (va[i] - vb[i]) / (2 * h);
  }
  return j;
}

// Relative error of |det j| because points round to the spacing of doubles. A slope counts as at least the one that the
// claimed determinant and the other slopes imply, so that a sample that does not follow u is no matter of rounding.
double rounding_error(const AnyDistribution& s, const Matrix<double>& j, double claimed,
                      const AnyDomain::Coordinates& v, double h) {
  const auto n = static_cast<std::size_t>(s.domain.dim);
  PerAxis<double> slopes{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t axis = 0; axis < n; ++axis) slopes[i] = std::max(slopes[i], std::abs(j[i][axis]));
  double error = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double implied = claimed;
    for (std::size_t k = 0; k < n; ++k)
      if (k != i) implied /= slopes[k];
    const double slope = std::max(slopes[i], implied);
    if (slope > 0) error += resolution(s.domain, s.epsilon(), v, i) / (h * slope);
  }
  return error;
}

// Estimates of two errors are subtracted: the spread of three steps, and the rounding of samples that are accurate to a
// few spacings of doubles. An ill-conditioned map may still show large rounding errors at single points, so the law
// tests the upper quartile.
std::vector<Check> double_jacobian(const AnyDistribution& s, const LawOptions& options) {
  constexpr double limit = 1e-6, first_step = 0x1p-12;
  const auto dim = static_cast<std::size_t>(s.domain.dim);
  struct Point {
    double off, product;
    AnyDistribution::Uniforms u;
  };
  std::vector<Point> points;
  Pcg random(options.statistics.seed, 33);
  for (int k = 0; k < 1000; ++k) {
    AnyDistribution::Uniforms u = rounded_uniforms(s, random);
    for (std::size_t i = 0; i < dim; ++i) u[i] = first_step + (1 - 2 * first_step - 0x1p-40) * u[i];
    const auto x = s.sample(u);
    if (!x || x->atom >= 0) continue;
    const AnyDomain::Coordinates v = s.domain.to_unit(x->x);
    const double claim = s.pdf(x->x) * s.domain.from_unit(v).jacobian;
    const std::array steps = {first_step, first_step / 2, first_step / 4};
    std::array<double, steps.size()> products;
    double noise = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto j = derivative(s, u, steps[i]);
      products[i] = j ? claim * std::abs(determinant(*j, dim)) : std::numeric_limits<double>::quiet_NaN();
      if (j) noise = rounding_error(s, *j, 1 / claim, v, steps[i]); // largest at the last, smallest step
    }
    const double spread = std::ranges::max(products) - std::ranges::min(products);
    const double off = std::abs(products.back() - 1) - 16 * spread - 4 * noise;
    points.push_back({off > 0 ? off : 0.0, products.back(), u});
  }
  Check check{"|det| pdf = 1, upper quartile", Verdict::pass, {}, 0, 0, limit, Fault::jacobian, {}};
  if (points.size() < 100) return {check};
  const auto quartile = points.begin() + static_cast<std::ptrdiff_t>(points.size() * 3 / 4);
  std::nth_element(points.begin(), quartile, points.end(),
                   [](const Point& a, const Point& b) { return a.off < b.off; });
  check.statistic = quartile->off;
  if (!(check.statistic <= limit)) {
    check.verdict = Verdict::fail;
    check.detail = fmt::format("|det d sample / d u| pdf is {:.9g}, should be 1, at {}", quartile->product,
                               describe_sample(s, quartile->u));
  }
  return {check};
}

} // namespace

Findings jacobian_law(const AnyDistribution& s, const LawOptions& options) {
  if (!s.sample || !s.invert || s.domain.dim == 0 || s.uniforms != s.domain.dim) return {};
  if (s.oracle) return {{oracle_jacobian(s, options)}};
  return {s.is_float ? std::vector<Check>{} : double_jacobian(s, options)};
}

} // namespace mc
