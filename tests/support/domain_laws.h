#pragma once
// The laws of a domain: its chart is one-to-one, and its Jacobian is the ratio of the measures.

#include <mc/check/subject/oracle.h>
#include <mc/check/subject/point_array.h>
#include <mc/domain/concept.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <numeric>

namespace support {

/// |dx/dv| at v by central differences with 50 digits. It is the root of the Gram determinant, which covers surfaces in
/// space.
template <mc::Domain D> mc::Oracle numeric_jacobian(const D& exact, const typename D::UnitPoint& v) {
  using mc::Oracle;
  const Oracle h(1e-20);
  std::array<decltype(mc::detail::to_array<Oracle>(v)), 3> slope{}; // derivatives of x along each axis of the chart
  for (int i = 0; i < D::dim; ++i) {
    auto ahead = mc::detail::to_array<Oracle>(v), behind = ahead;
    const auto axis = static_cast<std::size_t>(i);
    ahead[axis] += h;
    behind[axis] -= h;
    using Unit = typename D::UnitPoint;
    using Point = typename D::Point;
    const auto a = mc::detail::to_array<Oracle>(Point(exact.from_unit(mc::detail::to_point<Unit>(ahead))));
    const auto b = mc::detail::to_array<Oracle>(Point(exact.from_unit(mc::detail::to_point<Unit>(behind))));
    for (std::size_t k = 0; k < slope[axis].size(); ++k) slope[axis][k] = (a[k] - b[k]) / (2 * h);
  }
  const auto dot = [&](std::size_t i, std::size_t j) {
    return std::inner_product(slope[i].begin(), slope[i].end(), slope[j].begin(), Oracle(0));
  };
  const Oracle a = dot(0, 0), b = dot(0, 1), c = dot(1, 1);
  if constexpr (D::dim == 1) return sqrt(a);
  else if constexpr (D::dim == 2) return sqrt(a * c - b * b);
  else {
    const Oracle d = dot(0, 2), e = dot(1, 2), f = dot(2, 2);
    return sqrt(a * (c * f - e * e) - b * (b * f - d * e) + d * (b * e - c * d));
  }
}

/// The Jacobian with 50 digits agrees with the numerical one to 1e-15.
template <mc::Domain D> void expect_jacobian(const D& domain) {
  mc::Pcg random(6);
  const auto exact = domain.template cast<mc::Oracle>();
  for (int i = 0; i < 50; ++i) {
    const auto v = mc::cast_point<mc::Oracle>(random.template point<double, D::dim>());
    const mc::Oracle ratio = numeric_jacobian(exact, v) / exact.jacobian(v);
    ASSERT_LE(std::abs(static_cast<double>(ratio - 1)), 1e-15) << "at v = " << v;
  }
}

/// Checks the Jacobian, that points lie in the domain, and that round trips are accurate to `eps` machine epsilons of
/// the unit cube.
template <mc::Domain D> void expect_domain_laws(const D& domain, double eps) {
  using S = typename D::Scalar;
  const double bound = eps * static_cast<double>(std::numeric_limits<S>::epsilon());
  mc::Pcg random(11);
  for (int i = 0; i < 20'000; ++i) {
    const auto v = random.template point<S, D::dim>();
    const typename D::Point x = domain.from_unit(v);
    ASSERT_TRUE(domain.contains(x)) << "at v = " << v;
    const typename D::UnitPoint back = domain.to_unit(x);
    for (int k = 0; k < D::dim; ++k) {
      const double off = std::abs(mc::detail::component(back, k) - mc::detail::component(v, k));
      ASSERT_LE(std::min(off, std::abs(1 - off)), bound) << "at v = " << v; // an azimuth may wrap around
    }
  }
  expect_jacobian(domain);
}

} // namespace support
