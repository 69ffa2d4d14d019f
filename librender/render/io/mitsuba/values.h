#pragma once
/// Values of single elements of a scene file: <float value="1"/>, <rgb value="#ff8000"/>, <transform> and so on.

#include <render/core/transform.h>
#include <render/io/spectrum.h>
#include <render/io/xml.h>

#include <string>
#include <vector>

namespace render::mitsuba {

/// A number. Like all functions below, it throws Error "scene.xml:14: <float>: ..." for invalid input.

double parse_number(const XmlElement& element, const std::string& text);
/// A list of numbers of any length, separated by commas or blanks.
std::vector<double> parse_numbers(const XmlElement& element, const std::string& text);

/// The number in the attribute `value`.
double number_of(const XmlElement& element);
/// The integer in the attribute `value`.
int integer_of(const XmlElement& element);
/// true or false in the attribute `value`.
bool boolean_of(const XmlElement& element);
/// A vector from the attributes x, y, z (0 if missing), or from three numbers, or one for all, in the attribute
/// `value`.
Vec3d vector_of(const XmlElement& element);
/// Linear sRGB of a colour element. <rgb> is linear and <srgb> follows the sRGB curve; both accept one number, three
/// numbers or #rrggbb (255ths). <float> is grey, as in Mitsuba 3. <spectrum> is one number or wavelength:value pairs,
/// with values >= 0 and wavelengths that overlap 400..700 nm. Colours of spectra outside the sRGB gamut are clipped to
/// >= 0, except with constant extrapolation, as in lajolla.
Spectrum color_of(const XmlElement& element, Extrapolation extrapolation = Extrapolation::constant);
/// Like color_of, for a reflectance. Wavelength:value pairs are converted under the given illuminant. Under D65 colours
/// outside the gamut are clipped to [0, 1], as in Mitsuba 3.
Spectrum reflectance_of(const XmlElement& element, Illuminant illuminant,
                        Extrapolation extrapolation = Extrapolation::constant);
/// The product of lookAt, translate, scale, rotate and matrix, applied in the order of the file.
Transform transform_of(const XmlElement& element);

} // namespace render::mitsuba
