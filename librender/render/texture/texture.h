#pragma once
/// The closed set of textures.

#include <render/core/dispatch.h>
#include <render/texture/bitmap.h>
#include <render/texture/checkerboard.h>

namespace render {

/// A colour that varies over a surface. Each models:
///   eval(uv)             : the colour at a point of the surface
///   largest(), smallest() : bounds of it, per channel
struct Texture : std::variant<Checkerboard, Bitmap> {
  using variant::variant;

  Spectrum eval(const Vec2d& uv) const {
    return dispatch(*this, [&](const auto& t) { return t.eval(uv); });
  }
  Spectrum largest() const {
    return dispatch(*this, [](const auto& t) { return t.largest(); });
  }
  Spectrum smallest() const {
    return dispatch(*this, [](const auto& t) { return t.smallest(); });
  }
};

} // namespace render
