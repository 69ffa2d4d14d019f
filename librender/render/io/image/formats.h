#pragma once
/// One reader or writer per image format, each with its outside library behind one .cpp. Called through image_io.h.

#include <render/film/image.h>
#include <render/film/tone_mapping.h>

#include <string>

namespace render::formats {

void write_exr(const std::string& path, const Image& image);
Image read_exr(const std::string& path);
void write_pfm(const std::string& path, const Image& image);
Image read_pfm(const std::string& path);
void write_png(const std::string& path, const Image& image, const ToneMapping& tone);
Image read_png(const std::string& path);
Image read_jpeg(const std::string& path);
Image read_hdr(const std::string& path);

} // namespace render::formats
