#pragma once
/// Saving and loading of learned densities, for further runs on the same or a similar integrand.

#include <mc/estimate/adapt/adapted_density.h>

#include <string>
#include <string_view>

namespace mc {

/// Writes a density as lines of text. Every number has the fewest digits that give the same bits.
///   mc-density 1          (version of the format)
///   dim D
///   axis E0 E1 ...        (one line per axis: ImportanceGrid::bins + 1 edges of the grid)
///   tree N                (number of nodes of the tree within the grid, in preorder; 0: no tree)
///   cut AXIS PLACE        (or) leaf WEIGHT
///   checksum HEX          (64-bit FNV-1a of the bytes above)
std::string to_text(const AdaptedDensity& density);

/// Inverse of to_text(), exact bit by bit.
///   throws : Error that names the line and its expected content. Reasons are another version, a truncated or modified
///            text, decreasing edges, an invalid tree, or a density of 0.
AdaptedDensity density_from_text(std::string_view text);

/// Writes a density to a file. Throws Error with the name of the file.
void save_density(const std::string& path, const AdaptedDensity& density);
/// Reads a density from a file. Throws Error with the name of the file.
AdaptedDensity load_density(const std::string& path);

} // namespace mc
