#pragma once
/// Pictures that light or colour a scene.

#include <render/core/types.h>

#include <string>
#include <vector>

namespace render {

/// The values of a picture, row by row, the top row first. Shared by what uses it.
///   throws : Error unless there are width * height values, at least one
struct Texels {
  Texels(int w, int h, std::vector<Spectrum> v, const std::string& file = {})
      : width(w), height(h), values(std::move(v)), origin(file.empty() ? file : " of '" + file + "'") {
    mc::require(w >= 1 && h >= 1 && values.size() == static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
                "picture: {} values for {}x{}", values.size(), w, h);
  }
  int width, height;
  std::vector<Spectrum> values;
  std::string origin; ///< " of 'FILE'" for messages; empty where they come from no file
};

} // namespace render
