#pragma once
/// The closed set of textures.

#include <render/core/dispatch.h>
#include <render/texture/bitmap.h>
#include <render/texture/checkerboard.h>

namespace render {

/// A colour that varies over a surface. Each texture models:
///   eval(uv)                  : the colour at texture coordinates uv.
///   least()                   : the smallest value of any channel.
///   require_reflectance(what) : throws Error that begins with `what` and names the place, unless all values lie in [0,
///   1].
struct Texture : std::variant<Checkerboard, Bitmap> {
  using variant::variant;

  Spectrum eval(const Vec2d& uv) const {
    return dispatch(*this, [&](const auto& t) { return t.eval(uv); });
  }
  Float least() const {
    return dispatch(*this, [](const auto& t) { return t.least(); });
  }
  void require_reflectance(std::string_view what) const {
    dispatch(*this, [&](const auto& t) { t.require_reflectance(what); });
  }
};

} // namespace render
