#pragma once
/// Readers and writers, one per image format. Each uses its external library in one .cpp file. Called through
/// image_io.h.

#include <render/film/image.h>
#include <render/film/tone_mapping.h>

#include <cstdio>
#include <string>

namespace render::formats {

/// Writes OpenEXR to a stream that can seek.
void write_exr(std::FILE* stream, const Image& image);
/// Reads OpenEXR.
Image read_exr(const std::string& path);
/// Writes a portable float map.
void write_pfm(std::FILE* stream, const Image& image);
/// Reads a portable float map.
Image read_pfm(const std::string& path);
/// Writes an 8-bit PNG after tone mapping.
void write_png(std::FILE* stream, const Image& image, const ToneMapping& tone);
/// Reads PNG.
Image read_png(const std::string& path);
/// Reads JPEG.
Image read_jpeg(const std::string& path);
/// Reads Radiance HDR.
Image read_hdr(const std::string& path);

} // namespace render::formats
