#pragma once
// The readers of files from untrusted sources.

#include <render/io/image/formats.h>
#include <render/io/mesh/mesh.h>
#include <render/io/mitsuba/mitsuba.h>

#include <array>
#include <string>
#include <string_view>

namespace fuzz {

struct Reader {
  std::string_view format; ///< Folder of the corpus and extension of its files.
  void (*read)(const std::string& path);
};

inline constexpr std::array<Reader, 12> readers = {{
    {"bmp", [](const std::string& p) { render::formats::read_bmp(p); }},
    {"exr", [](const std::string& p) { render::formats::read_exr(p); }},
    {"hdr", [](const std::string& p) { render::formats::read_hdr(p); }},
    {"jpg", [](const std::string& p) { render::formats::read_jpeg(p); }},
    {"obj", [](const std::string& p) { render::to_shape(render::read_obj(p), {}); }},
    {"pfm", [](const std::string& p) { render::formats::read_pfm(p); }},
    {"ply", [](const std::string& p) { render::to_shape(render::read_ply(p), {}); }},
    {"png", [](const std::string& p) { render::formats::read_png(p); }},
    {"ppm", [](const std::string& p) { render::formats::read_ppm(p); }},
    {"serialized", [](const std::string& p) { render::to_shape(render::read_serialized(p, 0), {}); }},
    {"tga", [](const std::string& p) { render::formats::read_tga(p); }},
    {"xml", [](const std::string& p) { render::read_mitsuba(p); }},
}};

} // namespace fuzz
