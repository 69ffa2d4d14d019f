#pragma once
/// Images to and from files; the extension chooses the format.

#include <render/film/image.h>
#include <render/film/tone_mapping.h>

#include <string>

namespace render {

/// Writes by a temporary name, so that `path` holds the old image or the new one.
///   .exr : linear radiance R, G, B; where known, the variance of each pixel's mean as variance.R, .G, .B; 32-bit
///          float, with the metadata as string attributes and the number of estimates; further layers by their names
///   .pfm : linear radiance only, 32-bit float, no metadata (the format has no place for it)
///   .png : sRGB, 8 bit, of what `tone` makes of the radiance; metadata as text
///   throws : Error for another extension, a folder that is missing or not writable, a full disk
void write_image(const std::string& path, const Image& image, const ToneMapping& tone = {});

/// Linear radiance of .exr (channels R, G and B, or Y alone when it is grey; others are layers), .hdr, .pfm, .png or
/// .jpg.
///   .hdr : over the exposures and colour corrections of its header; mantissas are values, not the middles of what they
///          stand for; primaries are not looked at
///   .pfm : times the size of its header's scale; refused where more follows than its pixels
///   .exr : refused where it holds luminance and chroma, the sides of a cube, or says that its primaries are not those
///          of Rec. 709
///   .png, .jpg : decoded by the curve of sRGB, or, as a PNG's gAMA chunk says, a power; transparency is left out
///   throws : Error for a missing, damaged or truncated file, for a size that its bytes cannot hold, and for another
///            extension
Image read_image(const std::string& path);

} // namespace render
