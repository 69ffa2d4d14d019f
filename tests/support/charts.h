#pragma once
/// What every domain owes: a round trip of its chart, its Jacobian, and membership.

#include <mc/check/laws/oracle.h>
#include <mc/domain/concept.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace mc {

/// to_unit(from_unit(v)) = v within `eps` epsilons at random v, and the points are in the domain.
template <Domain D> void expect_round_trip(const D& domain, double eps) {
  using S = typename D::Scalar;
  Pcg random(5);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    typename D::UnitPoint v;
    if constexpr (D::dim == 1) v = random.uniform<S>();
    else v = random.point<S, D::dim>();
    const typename D::Point x = domain.from_unit(v);
    ASSERT_TRUE(domain.contains(x)) << x;
    const auto back = domain.to_unit(x);
    double off;
    if constexpr (D::dim == 1) off = std::abs(static_cast<double>(back - v));
    else off = static_cast<double>((back - v).template lpNorm<Eigen::Infinity>());
    worst = off <= worst ? worst : off; // NaN stays
  }
  EXPECT_LE(worst / static_cast<double>(std::numeric_limits<S>::epsilon()), eps);
}

/// |dx/dv| by central differences over 50 digits: the square root of the Gram determinant, so surfaces in space count
/// too.
template <class D> void expect_jacobian(const D& domain) {
  const Oracle h(1e-20);
  Pcg random(6);
  for (int k = 0; k < 50; ++k) {
    typename D::UnitPoint v;
    if constexpr (D::dim == 1) {
      v = Oracle(random.uniform<double>());
      const Oracle slope = (domain.from_unit(v + h) - domain.from_unit(v - h)) / (2 * h);
      EXPECT_LE(std::abs(static_cast<double>(Oracle(abs(slope) / domain.jacobian(v) - 1))), 1e-18);
    } else {
      v = random.point<double, D::dim>().template cast<Oracle>();
      Eigen::Matrix<Oracle, D::Point::SizeAtCompileTime, D::dim> jacobian;
      for (int i = 0; i < D::dim; ++i) {
        auto ahead = v, behind = v;
        ahead[i] += h, behind[i] -= h;
        const typename D::Point difference = domain.from_unit(ahead) - domain.from_unit(behind);
        jacobian.col(i) = difference / (2 * h);
      }
      Eigen::Matrix<Oracle, D::dim, D::dim> gram;
      for (int i = 0; i < D::dim; ++i)
        for (int j = 0; j < D::dim; ++j) gram(i, j) = jacobian.col(i).dot(jacobian.col(j));
      Oracle square;
      if constexpr (D::dim == 2) square = gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(1, 0);
      else square = gram.determinant();
      EXPECT_LE(std::abs(static_cast<double>(Oracle(sqrt(square) / domain.jacobian(v) - 1))), 1e-15);
    }
  }
}

} // namespace mc
