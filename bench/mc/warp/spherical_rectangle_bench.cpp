// A table of accuracy and time: the fan of two triangles against the parametrization of Urena et al. 2013 as published,
// float against 50 digits.
#include <mc/check/subject/oracle.h>
#include <mc/random/pcg.h>
#include <mc/warp/spherical_rectangle.h>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <vector>

namespace {

using namespace mc;

// The solid angle is the sum of the internal angles minus 2 pi. u0 cuts it by azimuth; the sine of the height is linear
// in u1.
template <class S> class Urena {
 public:
  Urena(const Vec3<S>& corner, const Vec3<S>& edge1, const Vec3<S>& edge2)
      : x_(edge1.normalized()), y_(edge2.normalized()), z_(cross<S>(x_, y_)) {
    using std::acos;
    z0_ = corner.dot(z_);
    if (z0_ > 0) {
      z_ = -z_;
      z0_ = -z0_;
    }
    x0_ = corner.dot(x_);
    x1_ = x0_ + edge1.norm();
    y0_ = corner.dot(y_);
    y1_ = y0_ + edge2.norm();
    const Vec3<S> v00(x0_, y0_, z0_), v01(x0_, y1_, z0_), v10(x1_, y0_, z0_), v11(x1_, y1_, z0_);
    const Vec3<S> n0 = cross<S>(v00, v10).normalized(), n1 = cross<S>(v10, v11).normalized(),
                  n2 = cross<S>(v11, v01).normalized(), n3 = cross<S>(v01, v00).normalized();
    const auto angle = [](const Vec3<S>& a, const Vec3<S>& b) { return S(acos(S(-a.dot(b)))); };
    b0_ = n0.z();
    b1_ = n2.z();
    k_ = 2 * pi<S> - angle(n2, n3) - angle(n3, n0);
    solid_angle_ = angle(n0, n1) + angle(n1, n2) - k_;
  }

  S solid_angle() const { return solid_angle_; }
  Vec3<S> sample(const Vec2<S>& u) const {
    using std::cos, std::max, std::min, std::sin, std::sqrt;
    const S au = u[0] * solid_angle_ + k_, fu = (S(cos(au)) * b0_ - b1_) / S(sin(au));
    const S cu = min(max(S((fu > 0 ? S(1) : S(-1)) / S(sqrt(S(fu * fu + b0_ * b0_)))), S(-1)), S(1));
    const S xu = min(max(S(-(cu * z0_) / max(S(sqrt(S(1 - cu * cu))), S(1e-30))), x0_), x1_);
    const S d = sqrt(S(xu * xu + z0_ * z0_)), h0 = y0_ / S(sqrt(S(d * d + y0_ * y0_))),
            h1 = y1_ / S(sqrt(S(d * d + y1_ * y1_)));
    const S h = h0 + u[1] * (h1 - h0), yv = h * h < 1 - S(1e-6) ? S(h * d / S(sqrt(S(1 - h * h)))) : y1_;
    return (x_ * xu + y_ * yv + z_ * z0_).normalized();
  }

 private:
  Vec3<S> x_, y_, z_;
  S z0_, x0_, y0_, x1_, y1_, b0_, b1_, k_, solid_angle_;
};

// Largest error of sample over 1000 points.
template <class W, class O> double worst(const W& warp, const O& exact) {
  Pcg random(1);
  double most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec2<float> u = random.point<float, 2>();
    const double off =
        static_cast<double>((cast_point<Oracle>(warp.sample(u)) - exact.sample(cast_point<Oracle>(u))).norm());
    most = off <= most ? most : off;
  }
  return most;
}

template <class F> double ns(const std::vector<Vec2<float>>& points, F sample) {
  std::vector<double> times;
  for (int round = 0; round < 15; ++round) {
    const std::clock_t start = std::clock();
    for (int k = 0; k < 8; ++k)
      for (const auto& u : points) {
        const Vec3<float> w = sample(u);
        asm volatile("" : : "r"(&w) : "memory");
      }
    times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC * 1e9 / 8 /
                    static_cast<double>(points.size()));
  }
  std::nth_element(times.begin(), times.begin() + 7, times.end());
  return times[7];
}

} // namespace

int main() {
  const double eps = std::numeric_limits<float>::epsilon();
  fmt::print("{:>10} {:>14} {:>14} {:>14} {:>14}   errors in eps; area relative\n", "sr", "fan: area", "sample",
             "Urena: area", "sample");
  for (const float edge : {1e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f, 10.0f, 100.0f}) {
    const Vec3<float> corner(-0.3f * edge, -0.4f * edge, 0.9f), ex(edge, 0, 0), ey(0, edge, 0);
    const SphericalRectangle<float> fan(corner, ex, ey);
    const auto exact = fan.cast<Oracle>();
    const Urena<float> other(corner, ex, ey);
    const Urena<Oracle> other_exact(cast_point<Oracle>(corner), cast_point<Oracle>(ex), cast_point<Oracle>(ey));
    const double area = static_cast<double>(exact.solid_angle());
    const auto off = [&](float a) { return std::abs(a / area - 1) / eps; };
    fmt::print("{:>10.3g} {:>14.2g} {:>14.3g} {:>14.2g} {:>14.3g}\n", area, off(fan.solid_angle()),
               worst(fan, exact) / eps, off(other.solid_angle()), worst(other, other_exact) / eps);
  }
  std::vector<Vec2<float>> points(1 << 15);
  Pcg random(2);
  for (auto& u : points) u = random.point<float, 2>();
  const Vec3<float> corner(-1, -1, 2), ex(2, 0, 0), ey(0, 2, 0);
  const SphericalRectangle<float> fan(corner, ex, ey);
  const Urena<float> other(corner, ex, ey);
  const auto at = [](const Vec2<float>& u) { return Vec3<float>(u[0] - 1.5f, u[1] - 1.5f, 2); };
  fmt::print("ns per sample: fan {:.1f}, Urena {:.1f}; made anew each time: fan {:.1f}, Urena {:.1f}\n",
             ns(points, [&](const auto& u) { return fan.sample(u); }),
             ns(points, [&](const auto& u) { return other.sample(u); }),
             ns(points, [&](const auto& u) { return SphericalRectangle<float>(at(u), ex, ey).sample(u); }),
             ns(points, [&](const auto& u) { return Urena<float>(at(u), ex, ey).sample(u); }));
}
