#pragma once
// The laws of a domain: its chart is one-to-one, and its Jacobian is the ratio of the measures.

#include <mc/check/laws/oracle.h>
#include <mc/domain/concept.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace support {

/// |dx/dv| at v by central differences over 50 digits: the absolute derivative, the area of a plane or surface element,
/// or the volume of a box.
template <mc::Domain D> double numeric_jacobian(const D& exact, const typename D::UnitPoint& v) {
  using mc::Oracle;
  const Oracle h("1e-18");
  if constexpr (D::dim == 1) {
    const Oracle d = (exact.from_unit(v + h) - exact.from_unit(v - h)) / (2 * h);
    return static_cast<double>(abs(d));
  } else {
    constexpr int rows = D::Point::RowsAtCompileTime;
    Eigen::Matrix<double, rows, D::dim> j;
    for (int i = 0; i < D::dim; ++i) {
      auto a = v, b = v;
      a[i] += h;
      b[i] -= h;
      const auto difference = (exact.from_unit(a) - exact.from_unit(b)).eval();
      for (int k = 0; k < rows; ++k) j(k, i) = static_cast<double>(Oracle(difference[k] / (2 * h)));
    }
    // The Gram determinant, by elimination: dimensions here are at most 3.
    Eigen::Matrix<double, D::dim, D::dim> gram = j.transpose() * j;
    double det = 1;
    for (int i = 0; i < D::dim; ++i) {
      det *= gram(i, i);
      for (int k = i + 1; k < D::dim; ++k) gram.row(k) -= gram(k, i) / gram(i, i) * gram.row(i);
    }
    return std::sqrt(det);
  }
}

/// Round trips within `eps` machine epsilons of the unit cube, points in the domain, Jacobian to 1e-6 of the numeric
/// one.
template <mc::Domain D> void expect_chart(const D& domain, double eps) {
  using S = typename D::Scalar;
  mc::Pcg random(11);
  const auto exact = domain.template cast<mc::Oracle>();
  for (int i = 0; i < 2000; ++i) {
    const auto v = random.template point<S, D::dim>();
    const auto x = domain.from_unit(v);
    ASSERT_TRUE(domain.contains(x)) << "at v = " << v;
    const auto back = domain.to_unit(x);
    const double bound = eps * double(std::numeric_limits<S>::epsilon());
    if constexpr (D::dim == 1) ASSERT_LE(std::abs(double(back) - double(v)), bound) << "at v = " << v;
    else
      for (int k = 0; k < D::dim; ++k) {
        const double d = std::abs(double(back[k]) - double(v[k]));
        ASSERT_LE(std::min(d, 1 - d), bound) << "at v = " << v.transpose(); // an azimuth may wrap
      }
    if (i < 50) {
      const auto w = mc::cast_point<mc::Oracle>(v);
      const double numeric = numeric_jacobian(exact, w), claimed = static_cast<double>(exact.jacobian(w));
      ASSERT_LE(std::abs(numeric / claimed - 1), 1e-6) << "at v = " << v;
    }
  }
}

} // namespace support
