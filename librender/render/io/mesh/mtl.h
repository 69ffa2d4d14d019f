#pragma once
/// Reader of Wavefront material files.

#include <render/core/types.h>

#include <map>
#include <optional>
#include <string>

namespace render {

/// A material as a file contains it, by the names of the format.
struct MtlMaterial {
  std::optional<Spectrum> Kd, ///< Diffuse colour.
      Ks,                     ///< Specular colour.
      Ke;                     ///< Emitted radiance.
  double Ns = 0,              ///< Exponent of the highlight.
      Ni = 1.5,               ///< Index of refraction.
      d = 1;                  ///< Opacity in [0, 1]; Tr is 1 - d.
  int illum = 2;              ///< Model of illumination; 4, 6, 7 and 9 are glass.
  std::string map_Kd;         ///< Path of the picture of Kd, relative to the file; empty: none.

  /// Whether light is refracted.
  bool is_glass() const { return illum == 4 || illum == 6 || illum == 7 || illum == 9; }
};

/// Reads the materials of a .mtl file by their names. Ignores other statements, and options of map_Kd.
///   throws : Error with file and line for a missing or broken file, and for a number that is missing or not finite, a
///            negative colour or exponent, an opacity outside [0, 1], and an index of refraction <= 0.
std::map<std::string, MtlMaterial, std::less<>> read_mtl(const std::string& path);

} // namespace render
