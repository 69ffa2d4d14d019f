#pragma once
/// Plugins of Mitsuba that librender does not read.

#include <string_view>

namespace render::mitsuba {

/// Why a plugin of Mitsuba is not supported, and what to use instead: "there are no spotlights; use a small area
/// light". Empty for a name that is no well-known plugin of this element.
///   tag : "bsdf", "emitter", ...
std::string_view why_unsupported(std::string_view tag, std::string_view type);

} // namespace render::mitsuba
