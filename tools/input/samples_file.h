#pragma once
/// Checks samples from a file against a density, given on a grid or as an expression.

#include <catalogue/catalogue.h>

#include <cstdint>
#include <string>

namespace carlo {

struct SamplesFileOptions {
  std::string samples; ///< CSV
  std::string pdf;     ///< CSV, .exr or .pfm
  std::string density; ///< instead of pdf: an expression in the names of the columns
  /// Domain of the grid: "x=lo:hi", "x=lo:hi,y=lo:hi" or "sphere"; with an expression, any domain of parse_domain. If
  /// it is empty, the number of columns decides: [0,1] for 1, [0,1]^2 for 2, the sphere for 3.
  std::string domain;
  std::string breaks;        ///< for an expression, see parse_breaks; may be empty
  bool unnormalized = false; ///< the input is only proportional to the density
  bool dependent = false;    ///< the rows need not be independent; else their order and evenness are tested
  bool is_log = false;       ///< the expression is the logarithm of the density
  std::string thin;          ///< keep each K-th row: "auto" or K; empty: all
};

/// A case and the largest number of samples that its checks can use.
struct SamplesFileCase {
  Case one;
  std::uint64_t samples = 0;
  std::string note = {}; ///< a sentence for the user before the check; may be empty
};

/// The file's samples as one case.
///   samples : one in each row: x on an interval, x and y on a rectangle, a unit vector x, y, z (to 1e-5) on the
///             sphere.
///   pdf     : W numbers in H rows, the mean of the density over each cell. On a rectangle cell (i, j), column i of row
///             j, spans x in lo + (hi - lo) [i, i + 1] / W, and y in the same way by j / H. The first row has the
///             smallest y. On an interval H = 1. On the sphere the cell spans azimuth 2 pi [i, i + 1] / W from +x
///             toward +y and angle pi [j, j + 1] / H from +z. An image is grey, its top row first. The integral over
///             the domain (length, area, solid angle) is 1 to 1e-4, or arbitrary with `unnormalized`.
///   method  : a sample becomes a uniform point of its cell. The inverse of the grid's own distribution function maps
///             this point to the unit square, where the expected density is the constant 1. So expected counts are
///             exact, and a density that varies within a cell is no fault. Errors within cells are not detected. A
///             sample in a cell of density 0 is a leak, unless it lies within 1e-6 of a positive cell. A random ninth
///             of the rows, at most 2^20, determines the bins.
///   throws  : Error for a file that is missing or broken ("s.csv:17: ..."), fewer than 2000 samples, a sample outside
///             of the domain, a grid with a number that is not finite and >= 0, or a grid of zeros.
SamplesFileCase samples_file_case(const SamplesFileOptions& options);

} // namespace carlo
