#pragma once
/// The closed set of textures.

#include <render/core/dispatch.h>
#include <render/texture/bitmap.h>
#include <render/texture/checkerboard.h>

namespace render {

/// A colour that varies over a surface. Each texture models:
///   eval(uv, footprint)       : the colour at texture coordinates uv. A texture that is_filtered() averages it over
///                               about footprint^2 of the texture coordinates.
///   is_filtered()             : whether the colour depends on the footprint.
///   least()                   : the smallest value of any channel.
///   require_reflectance(what) : throws Error that begins with `what` and names the place, unless all values lie in [0,
///   1].
struct Texture : std::variant<Checkerboard, Bitmap> {
  using variant::variant;

  Spectrum eval(const Vec2d& uv, Float footprint = 0) const {
    return dispatch(*this, [&](const auto& t) { return t.eval(uv, footprint); });
  }
  bool is_filtered() const {
    return dispatch(*this, [](const auto& t) { return t.is_filtered(); });
  }
  Float least() const {
    return dispatch(*this, [](const auto& t) { return t.least(); });
  }
  void require_reflectance(std::string_view what) const {
    dispatch(*this, [&](const auto& t) { t.require_reflectance(what); });
  }
};

} // namespace render
