#include <render/io/spectrum.h>

#include <mc/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace render {

namespace {

// An asymmetric Gaussian with different widths on the left and right of its centre.
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

constexpr double cie_y_integral = 106.856895; // integral of the tabulated y-bar [nm]

// Relative power of D65 at 400, 410, ..., 700 nm.
constexpr std::array<double, 31> d65 = {82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
                                        115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
                                        100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886,
                                        83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091};

double daylight(int wavelength) {
  const int i = std::min((wavelength - 400) / 10, 29);
  const double t = (wavelength - 400) / 10.0 - i;
  return (1 - t) * d65[static_cast<std::size_t>(i)] + t * d65[static_cast<std::size_t>(i) + 1];
}

double value_at(const std::vector<SpectralSample>& s, double wavelength) {
  if (wavelength < s.front().wavelength) return 0;
  for (std::size_t i = 1; i < s.size(); ++i)
    if (wavelength <= s[i].wavelength) {
      const double t = (wavelength - s[i - 1].wavelength) / (s[i].wavelength - s[i - 1].wavelength);
      return (1 - t) * s[i - 1].value + t * s[i].value;
    }
  return wavelength == s.back().wavelength ? s.back().value : 0;
}

// Adds the samples that represent the extrapolation. The spectrum is 0 beyond the result.
std::vector<SpectralSample> extended(std::vector<SpectralSample> s, Extrapolation extrapolation) {
  const SpectralSample first = s.front(), last = s.back();
  if (extrapolation == Extrapolation::constant || s.size() == 1) {
    s.insert(s.begin(), {std::min(0.0, first.wavelength - 1), first.value});
    s.push_back({std::max(1e6, last.wavelength + 1), last.value});
  } else if (extrapolation == Extrapolation::ramp) {
    const double step = (last.wavelength - first.wavelength) / double(s.size() - 1);
    s.insert(s.begin(), {first.wavelength - step, 0});
    s.push_back({last.wavelength + step, 0});
  }
  return s;
}

} // namespace

Eigen::Array3d xyz_to_rgb(const Vec3d& xyz) {
  Eigen::Matrix3d to_rgb;
  to_rgb << 3.240479, -1.537150, -0.498535, -0.969256, 1.875991, 0.041556, 0.055648, -0.204043, 1.057311;
  return (to_rgb * xyz).array();
}

Spectrum spectrum_to_rgb(const std::vector<SpectralSample>& samples, Illuminant illuminant,
                         Extrapolation extrapolation) {
  mc::require(!samples.empty(), "spectrum: no samples; give wavelength:value pairs");
  for (std::size_t i = 0; i < samples.size(); ++i)
    mc::require(std::isfinite(samples[i].value) && std::isfinite(samples[i].wavelength) &&
                    (i == 0 || samples[i].wavelength > samples[i - 1].wavelength),
                "spectrum: sample {} ({}:{}) must be finite and of a longer wavelength than the one before", i,
                samples[i].wavelength, samples[i].value);
  const std::vector<SpectralSample> whole = extended(samples, extrapolation);
  Vec3d xyz = Vec3d::Zero(), white = Vec3d::Zero();
  for (int w = 400; w <= 700; ++w) {
    const Vec3d seen = matching_functions(w) * (illuminant == Illuminant::d65 ? daylight(w) : 1);
    xyz += value_at(whole, w) * seen;
    white += seen;
  }
  if (illuminant == Illuminant::d65) return (xyz_to_rgb(xyz) / xyz_to_rgb(white)).cast<Float>();
  return xyz_to_rgb(xyz / cie_y_integral).cast<Float>();
}

} // namespace render
