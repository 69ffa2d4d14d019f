#pragma once
/// Reading and writing of images; the extension selects the format.

#include <render/film/image.h>
#include <render/film/tone_mapping.h>
#include <render/io/image/transfer.h>

#include <optional>
#include <string>

namespace render {

/// Writes an image to a temporary file and renames it, so that `path` always holds the old or the new image.
///   .exr : linear radiance R, G, B, and, if known, the variance of the mean of each pixel as variance.R, .G, .B.
///          32-bit float. Metadata are string attributes, with the number of estimates. Further layers are stored by
///          name.
///   .pfm : linear radiance only, 32-bit float. The format has no place for metadata.
///   .png : sRGB, 8 bit, after tone mapping by `tone`. Metadata are text.
///   throws : Error for another extension, a folder that is missing or not writable, or a full disk.
void write_image(const std::string& path, const Image& image, const ToneMapping& tone = {});

/// Reads linear radiance from .exr, .hdr, .pfm, .png, .jpg, .bmp, .tga, .ppm or .pgm.
///   .exr : channels R, G and B, or Y alone for grey; other channels are layers. Rejects luminance-chroma images, cube
///          maps, and primaries other than the Rec. 709 primaries.
///   .hdr : divides by the exposures and colour corrections of the header. Mantissas are exact values, not centres of
///          quantization intervals. Ignores primaries.
///   .pfm : multiplies by the size of the scale in the header. Rejects data after the last pixel.
///   .png, .jpg, .bmp, .tga, .ppm, .pgm : decodes the sRGB curve, or the power in the gAMA chunk of a PNG. Ignores
///          transparency.
///   transfer : decodes these formats instead, whatever the file says. Other formats are linear.
///   throws : Error for a missing, damaged or truncated file, a size that its bytes cannot hold, or another extension.
///            Error for a transfer that is not linear, if the format is.
Image read_image(const std::string& path, const std::optional<Transfer>& transfer = {});

} // namespace render
