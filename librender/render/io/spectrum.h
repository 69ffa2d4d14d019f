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

/// What a spectrum is beyond its samples; of one sample, always constant.
enum class Extrapolation {
  constant, ///< constant, as in lajolla
  ramp,     ///< linear to 0 within their mean distance, as in Mitsuba 0.6
  zero      ///< 0, as in Mitsuba 3
};

/// Linear sRGB of a spectrum, piecewise linear between samples of increasing wavelength: the sum over 400..700 nm in
/// 1 nm steps against the CIE 1931 colour matching functions, normalised so that the constant 1 has Y = 1, then
/// xyz_to_rgb. Under D65 the constant 1 is white, (1, 1, 1).
///   error  : the analytic fit of the matching functions is good to about 1 %
///   throws : Error unless the wavelengths increase and all numbers are finite
///   Source : [WymanSloanShirley13], multi-lobe fit; D65 of ISO/CIE 11664-2
Spectrum spectrum_to_rgb(const std::vector<SpectralSample>& samples, Illuminant illuminant = Illuminant::equal_energy,
                         Extrapolation extrapolation = Extrapolation::constant);

} // namespace render
