#pragma once
// Directional albedos by sampling.

#include <render/bsdf/concept.h>

namespace support {

inline render::Vec3 at_degrees(double angle) {
  const double theta = angle * mc::pi<double> / 180;
  return render::Vec3d(std::sin(theta), 0, std::cos(theta)).cast<render::Float>();
}

// Mean of f |cos| eta^2 / pdf over n points: the share of light that is scattered.
template <class B> double albedo(const B& bsdf, double cosine, int n = 1 << 18) {
  using namespace render;
  const Vec3 wo = Vec3d(std::sqrt(1 - cosine * cosine), 0, cosine).cast<Float>();
  double sum = 0;
  // Multiples of the inverse powers of the root of x^4 = x + 1, which fill three dimensions evenly.
  std::uint32_t a = 0, b = 0, c = 0;
  for (int i = 0; i < n; ++i) {
    a += 3518319155u;
    b += 2882110345u;
    c += 2360945575u;
    const auto number = [](std::uint32_t x) { return Float(double(x >> 8) * 0x1p-24); };
    const auto s = bsdf.sample(wo, number(a), Vec2(number(b), number(c)));
    if (s && s->pdf > 0)
      sum += double(s->f[0]) * std::abs(double(s->wi.z())) * double(s->eta) * double(s->eta) / double(s->pdf);
  }
  return sum / n;
}

} // namespace support
