#pragma once
/// Conversion of tabulated spectra to linear sRGB.

#include <render/core/types.h>

#include <vector>

namespace render {

/// CIE XYZ to linear sRGB, IEC 61966-2-1.
Eigen::Array3d xyz_to_rgb(const Vec3d& xyz);

/// A value at a wavelength [nm].
struct SpectralSample {
  double wavelength, ///< Wavelength [nm].
      value;         ///< Value at this wavelength.
};

/// Illuminant of reflectance spectra: equal energy at every wavelength, or daylight D65.
enum class Illuminant { equal_energy, d65 };

/// Values of a spectrum outside the range of its samples. A spectrum with one sample is always constant.
enum class Extrapolation {
  constant, ///< Constant, as in lajolla.
  ramp,     ///< Linear to 0 within the mean distance of the samples, as in Mitsuba 0.6.
  zero      ///< 0, as in Mitsuba 3.
};

/// Linear sRGB of a spectrum that is piecewise linear between samples of increasing wavelength. Sums over 400..700 nm
/// in steps of 1 nm with the CIE 1931 colour matching functions. The sum is normalized so that the constant 1 has Y = 1
/// and converted by xyz_to_rgb. Under D65 the constant 1 is white, (1, 1, 1).
///   error  : the analytic fit of the matching functions is accurate to about 1 %.
///   throws : Error unless the wavelengths increase and all numbers are finite.
///   Source : [WymanSloanShirley13], multi-lobe fit; D65 of ISO/CIE 11664-2.
Spectrum spectrum_to_rgb(const std::vector<SpectralSample>& samples, Illuminant illuminant = Illuminant::equal_energy,
                         Extrapolation extrapolation = Extrapolation::constant);

} // namespace render
