#pragma once
/// Images that illuminate or colour a scene.

#include <render/core/types.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// The values of an image in row order, the top row first. Shared by its users.
///   throws : Error unless there are width * height values, at least one.
struct Texels {
  /// An image of w x h values; `file` appears in error messages.
  Texels(int w, int h, std::vector<Spectrum> v, const std::string& file = {})
      : width(w), height(h), values(std::move(v)), origin(file.empty() ? file : " of '" + file + "'") {
    mc::require(w >= 1 && h >= 1 && values.size() == static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
                "picture: {} values for {}x{}", values.size(), w, h);
  }

  /// The value in a column and a row.
  const Spectrum& at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }

  /// Throws Error "WHO: texel (1, 0) of 'FILE' = (2, 0, 0) WRONG" for the first value for which is_good is false.
  template <class F> void require_all(std::string_view who, std::string_view wrong, const F& is_good) const {
    const auto bad = std::find_if_not(values.begin(), values.end(), is_good);
    if (bad == values.end()) return;
    const auto i = bad - values.begin();
    throw mc::Error(fmt::format("{}: texel ({}, {}){} = ({}, {}, {}) {}", who, i % width, i / width, origin, (*bad)[0],
                                (*bad)[1], (*bad)[2], wrong));
  }

  int width,                    ///< Number of columns.
      height;                   ///< Number of rows.
  std::vector<Spectrum> values; ///< Values in row order.
  std::string origin;           ///< " of 'FILE'" for error messages; empty if there is no file.
};

} // namespace render
