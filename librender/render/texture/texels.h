#pragma once
/// Pictures that light or colour a scene.

#include <render/core/types.h>

#include <algorithm>
#include <string>
#include <string_view>
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

  /// Throws Error "WHO: texel (1, 0) of 'FILE' = (2, 0, 0) WRONG" for the first value that is not good.
  template <class F> void require_all(std::string_view who, std::string_view wrong, const F& is_good) const {
    const auto bad = std::find_if_not(values.begin(), values.end(), is_good);
    if (bad == values.end()) return;
    const auto i = bad - values.begin();
    throw mc::Error(fmt::format("{}: texel ({}, {}){} = ({}, {}, {}) {}", who, i % width, i / width, origin, (*bad)[0],
                                (*bad)[1], (*bad)[2], wrong));
  }

  int width, height;
  std::vector<Spectrum> values;
  std::string origin; ///< " of 'FILE'" for messages; empty where they come from no file
};

} // namespace render
