#pragma once
/// Samples drawn by anything, against a density on a grid or one that is an expression.

#include <catalogue/catalogue.h>

#include <cstdint>
#include <string>

namespace carlo {

struct SamplesFileOptions {
  std::string samples; ///< CSV
  std::string pdf;     ///< CSV, .exr or .pfm
  std::string density; ///< or an expression in the names of the columns
  /// Of the grid: "x=lo:hi", "x=lo:hi,y=lo:hi" or "sphere"; with an expression, any of parse_domain. Empty: by the
  /// columns, 1 or 2 in [0,1], 3 the sphere.
  std::string domain;
  std::string breaks;        ///< of an expression, see parse_breaks; may be empty
  bool unnormalized = false; ///< what is given is only proportional to the density
};

/// A case and the most samples that it can count.
struct SamplesFileCase {
  Case one;
  std::uint64_t samples = 0;
};

/// The file's samples as one case.
///   samples : a row each: x on an interval, x and y on a rectangle, a unit vector x, y, z (to 1e-5) on the sphere
///   pdf     : W numbers in H rows, the mean of the density over each cell. On a rectangle cell (i, j), column i of row
///             j, spans x in lo + (hi - lo) [i, i + 1] / W and y alike by j / H, the first row at the least y; on an
///             interval H = 1; on the sphere it spans azimuth 2 pi [i, i + 1] / W from +x toward +y and angle pi [j, j
///             + 1] / H from +z. An image is grey, its top row first. The integral over the domain (length, area, solid
///             angle) is 1 to 1e-4, or any with unnormalized.
///   method  : a sample becomes a uniform point of its cell, and that a point of the unit square by the inverse of the
///             grid's own distribution function, where the claim is the constant 1: expected counts are exact, and a
///             density that varies within a cell is no fault. What is wrong only within cells is not seen. A sample in
///             a cell of density 0 is a leak, unless it lies within 1e-6 of a positive one. A ninth of the rows, at
///             most 2^20, chosen by the seed, makes the bins.
///   throws  : Error for a file that is missing or broken ("s.csv:17: ..."), fewer than 2000 samples, a sample off the
///             domain, a grid that holds a number that is not finite and >= 0, or nothing but zeros
SamplesFileCase samples_file_case(const SamplesFileOptions& options);

} // namespace carlo
