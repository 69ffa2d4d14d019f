#pragma once
/// Readers and writers, one per image format. Each uses its external library in one .cpp file. Called through
/// image_io.h.

#include <render/film/image.h>
#include <render/film/tone_mapping.h>
#include <render/io/image/transfer.h>

#include <cstdio>
#include <optional>
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
/// Reads PNG. A transfer replaces the curve that the file names.
Image read_png(const std::string& path, const std::optional<Transfer>& transfer = {});
/// Reads JPEG; by the sRGB curve unless a transfer is given.
Image read_jpeg(const std::string& path, const std::optional<Transfer>& transfer = {});
/// Reads BMP, uncompressed with 24 or 32 bits per pixel; by the sRGB curve unless a transfer is given.
Image read_bmp(const std::string& path, const std::optional<Transfer>& transfer = {});
/// Reads TGA in true colour (24 or 32 bits) or grey (8 bits), also run-length encoded; by the sRGB curve unless a
/// transfer is given.
Image read_tga(const std::string& path, const std::optional<Transfer>& transfer = {});
/// Reads PPM and PGM, binary or text; by the sRGB curve unless a transfer is given.
Image read_ppm(const std::string& path, const std::optional<Transfer>& transfer = {});
/// Reads Radiance HDR.
Image read_hdr(const std::string& path);

} // namespace render::formats
