#include <render/io/spectrum.h>

#include <mc/core/error.h>

#include <cmath>

namespace render {

namespace {

// A Gaussian whose width differs left and right of its centre.
double lobe(double wavelength, double center, double left, double right) {
  const double t = (wavelength - center) * (wavelength < center ? left : right);
  return std::exp(-0.5 * t * t);
}

Vec3d matching_functions(double w) {
  return {0.362 * lobe(w, 442.0, 0.0624, 0.0374) + 1.056 * lobe(w, 599.8, 0.0264, 0.0323) -
              0.065 * lobe(w, 501.1, 0.0490, 0.0382),
          0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
          1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725)};
}

constexpr double cie_y_integral = 106.856895; // of the tabulated y-bar, per nm

double value_at(const std::vector<SpectralSample>& s, double wavelength) {
  if (wavelength <= s.front().wavelength) return s.front().value;
  for (std::size_t i = 1; i < s.size(); ++i)
    if (wavelength <= s[i].wavelength) {
      const double t = (wavelength - s[i - 1].wavelength) / (s[i].wavelength - s[i - 1].wavelength);
      return (1 - t) * s[i - 1].value + t * s[i].value;
    }
  return s.back().value;
}

} // namespace

Eigen::Array3d xyz_to_rgb(const Vec3d& xyz) {
  Eigen::Matrix3d to_rgb;
  to_rgb << 3.240479, -1.537150, -0.498535, -0.969256, 1.875991, 0.041556, 0.055648, -0.204043, 1.057311;
  return (to_rgb * xyz).array();
}

Spectrum spectrum_to_rgb(const std::vector<SpectralSample>& samples) {
  mc::require(!samples.empty(), "spectrum: no samples; give wavelength:value pairs");
  for (std::size_t i = 0; i < samples.size(); ++i)
    mc::require(std::isfinite(samples[i].value) && std::isfinite(samples[i].wavelength) &&
                    (i == 0 || samples[i].wavelength > samples[i - 1].wavelength),
                "spectrum: sample {} ({}:{}) must be finite and of a longer wavelength than the one before", i,
                samples[i].wavelength, samples[i].value);
  Vec3d xyz = Vec3d::Zero();
  for (int w = 400; w <= 700; ++w) xyz += value_at(samples, w) * matching_functions(w);
  xyz /= cie_y_integral;
  return xyz_to_rgb(xyz).cast<Float>();
}

} // namespace render
