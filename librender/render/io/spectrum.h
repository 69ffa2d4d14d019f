#pragma once
/// Tabulated spectra to linear sRGB.

#include <render/core/types.h>

#include <vector>

namespace render {

/// CIE XYZ to linear sRGB, IEC 61966-2-1.
Eigen::Array3d xyz_to_rgb(const Vec3d& xyz);

/// A value at a wavelength [nm].
struct SpectralSample {
  double wavelength, value;
};

/// Light that what reflects is seen in: of equal energy at every wavelength, or daylight.
enum class Illuminant { equal_energy, d65 };

/// Linear sRGB of a spectrum that is piecewise linear between samples of increasing wavelength and constant beyond
/// them: the sum over 400..700 nm in 1 nm steps against the CIE 1931 colour matching functions, normalised so that the
/// constant 1 has Y = 1, then xyz_to_rgb. Under D65 the constant 1 is white, (1, 1, 1).
///   error  : the analytic fit of the matching functions is good to about 1 %
///   throws : Error unless the wavelengths increase and all numbers are finite
///   Source : [WymanSloanShirley13], multi-lobe fit; D65 of ISO/CIE 11664-2
Spectrum spectrum_to_rgb(const std::vector<SpectralSample>& samples, Illuminant illuminant = Illuminant::equal_energy);

} // namespace render
