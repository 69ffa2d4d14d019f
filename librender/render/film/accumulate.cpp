#include <render/film/accumulate.h>

#include <mc/core/error.h>

namespace render {

Image accumulate(const Image& a, double a_samples, const Image& b, double b_samples) {
  mc::require(a.width == b.width && a.height == b.height, "a picture of {}x{} cannot go on as one of {}x{}", a.width,
              a.height, b.width, b.height);
  mc::require(a_samples > 0 && b_samples > 0, "pictures of {} and {} samples per pixel; both must be > 0", a_samples,
              b_samples);
  const double w = a_samples / (a_samples + b_samples);
  const auto mix = [](const Spectrum& x, double wx, const Spectrum& y, double wy) -> Spectrum {
    return (wx * x.cast<double>() + wy * y.cast<double>()).cast<Float>();
  };
  Image sum = b;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] = mix(a.pixels[i], w, b.pixels[i], 1 - w);
  sum.variance.clear();
  sum.estimates = 0;
  if (a.variance.empty() || b.variance.empty()) return sum;
  sum.estimates = a.estimates + b.estimates;
  sum.noise_area = std::max(a.noise_area, b.noise_area);
  for (std::size_t i = 0; i < sum.pixels.size(); ++i)
    sum.variance.push_back(mix(a.variance[i], mc::sqr(w), b.variance[i], mc::sqr(1 - w)));
  return sum;
}

} // namespace render
