#pragma once
/// Options of a picture that is written: its format, and the tone of a PNG.

#include <render/film/tone_mapping.h>

#include <string>

namespace carlo {

/// Throws Error where a picture cannot be written to `path`: its format or its folder. Call it before the work.
void require_picture_output(const std::string& path);

/// The tone that --tone and --exposure choose. An empty text leaves the part of `start` as it is, as does the exposure
/// auto, which depends on the picture.
///   throws : Error for an unknown curve, and unless the exposure is a number in [-100, 100] or auto.
render::ToneMapping parse_tone(const std::string& curve, const std::string& exposure,
                               const render::ToneMapping& start = {});

} // namespace carlo
