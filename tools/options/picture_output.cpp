#include <options/picture_output.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <cmath>
#include <cstdio>

namespace carlo {

void require_picture_output(const std::string& path) {
  mc::require_writable(path);
  const std::string extension = mc::lowercase_extension(path);
  mc::require(extension == ".exr" || extension == ".pfm" || extension == ".png",
              "cannot write '{}': unknown image format '{}'; use .exr, .pfm or .png", path, extension);
}

render::ToneMapping parse_tone(const std::string& curve, const std::string& exposure,
                               const render::ToneMapping& start) {
  render::ToneMapping tone = start;
  if (!curve.empty()) tone.curve = render::tone_curve_from(curve);
  if (exposure.empty() || exposure == "auto") return tone;
  char rest = 0;
  mc::require(std::sscanf(exposure.c_str(), "%lf%c", &tone.exposure, &rest) == 1 && std::abs(tone.exposure) <= 100,
              "--exposure '{}' must be a number of stops in [-100, 100], or auto", exposure);
  return tone;
}

} // namespace carlo
