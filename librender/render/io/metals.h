#pragma once
/// Measured optical constants of metals.

#include <render/core/types.h>

#include <string_view>
#include <vector>

namespace render {

/// Index of refraction and extinction coefficient in vacuum, per channel.
struct OpticalConstants {
  Spectrum eta, ///< Index of refraction.
      k;        ///< Extinction coefficient.
};

/// Names of the metals in the table, as Mitsuba spells them: Ag, Al, Au, ...
std::vector<std::string_view> metal_names();

/// Optical constants of a metal by its name in Mitsuba. The measured values are linear between their wavelengths.
/// spectrum_to_rgb() converts eta and k separately with equal energy at every wavelength, as the RGB modes of Mitsuba
/// do. Mitsuba's own table has other sources for some metals, so colours differ slightly.
///   throws : Error for an unknown name, with the most similar one.
///   Source : metals.cpp names the publication of each metal. The numbers are the copies in the public-domain database
///            refractiveindex.info of M. N. Polyanskiy.
OpticalConstants metal_constants(std::string_view name);

} // namespace render
