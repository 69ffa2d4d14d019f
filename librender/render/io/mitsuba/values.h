#pragma once
/// What one element of a scene file says: <float value="1"/>, <rgb value="#ff8000"/>, <transform> and the like.

#include <render/core/transform.h>
#include <render/io/spectrum.h>
#include <render/io/xml.h>

#include <string>
#include <vector>

namespace render::mitsuba {

/// Every function throws Error "scene.xml:14: <float>: ..." for what cannot be read.

double parse_number(const XmlElement& element, const std::string& text);
/// Numbers separated by commas or blanks, as many as there are.
std::vector<double> parse_numbers(const XmlElement& element, const std::string& text);

double number_of(const XmlElement& element);
int integer_of(const XmlElement& element);
bool boolean_of(const XmlElement& element);
/// x, y, z attributes, those that are missing 0; or three numbers, or one for all, as the value.
Vec3d vector_of(const XmlElement& element);
/// Linear sRGB of <rgb> (linear) or <srgb> (by the sRGB curve), each as one number, three or #rrggbb (255ths), of
/// <float>, a grey as in Mitsuba 3, and of <spectrum>, as one number or wavelength:value pairs, with values >= 0 and
/// wavelengths that reach into 400..700 nm. Unless these are held, as in lajolla, colours that the screen does not have
/// become the nearest >= 0.
Spectrum color_of(const XmlElement& element, Extrapolation extrapolation = Extrapolation::constant);
/// The same of what reflects: wavelength:value pairs are seen in that light, and under D65 colours that the screen does
/// not have become the nearest in [0, 1], as in Mitsuba 3.
Spectrum reflectance_of(const XmlElement& element, Illuminant illuminant,
                        Extrapolation extrapolation = Extrapolation::constant);
/// lookAt, translate, scale, rotate and matrix, applied in the order in which they stand.
Transform transform_of(const XmlElement& element);

} // namespace render::mitsuba
