#pragma once
/// Plugins of Mitsuba that librender does not support.

#include <string_view>

namespace render::mitsuba {

/// Why a plugin of Mitsuba is not supported, and the alternative: "there are no spotlights; use a small area light".
/// Empty if `type` is no well-known plugin of this tag.
///   tag : "bsdf", "emitter", ...
std::string_view why_unsupported(std::string_view tag, std::string_view type);

} // namespace render::mitsuba
