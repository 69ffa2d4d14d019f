#pragma once
/// Images to and from files; the extension chooses the format.

#include <render/film/image.h>

#include <string>

namespace render {

/// Writes by a temporary name, so that `path` holds the old image or the new one.
///   .exr : linear radiance R, G, B; where known, the variance of each pixel's mean as variance.R, .G, .B; 32-bit
///          float, with the metadata as string attributes
///   .pfm : linear radiance only, 32-bit float, no metadata (the format has no place for it)
///   .png : sRGB, 8 bit, after multiplication by 2^exposure; metadata as text
///   throws : Error for another extension, a folder that is missing or not writable, a full disk
void write_image(const std::string& path, const Image& image, double exposure = 0);

/// Reads .exr (channels R, G and B, or Y alone when it is grey) or .pfm. Throws Error for a missing or damaged file or
/// another extension.
Image read_image(const std::string& path);

} // namespace render
