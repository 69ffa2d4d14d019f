#pragma once
/// Densities in files: what was learned of one integrand serves the next run, or one like it.

#include <mc/estimate/adapt/adapted_density.h>

#include <string>
#include <string_view>

namespace mc {

/// A density as lines of text, every number in the fewest digits that give the same bits:
///   mc-density 1          (the version of the format)
///   dim D
///   axis E0 E1 ...        (for each axis the edges of the grid, ImportanceGrid::bins + 1 numbers)
///   tree N                (nodes of the tree within the grid, in preorder; 0: no tree)
///   cut AXIS PLACE        (or) leaf WEIGHT
///   checksum HEX          (64-bit FNV-1a of the bytes above)
std::string to_text(const AdaptedDensity& density);

/// The density that to_text was given, bit for bit.
///   throws : Error that names the line and what it should hold, for another version, a text that is cut short or
///            changed, edges that fall, a tree that is none, a density that is 0 somewhere
AdaptedDensity density_from_text(std::string_view text);

/// To and from a file. Throws Error with the file's name.
void save_density(const std::string& path, const AdaptedDensity& density);
AdaptedDensity load_density(const std::string& path);

} // namespace mc
