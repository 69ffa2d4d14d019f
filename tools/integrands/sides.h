#pragma once
/// Boxes on the command line.

#include <string>
#include <vector>

namespace carlo {

/// A variable with its bounds, lo < hi; either may be infinite.
struct Side {
  std::string name;
  double lo, hi;

  bool is_finite() const;
};

/// "x=0:1,y=-1:2,z=0:inf". Throws Error that names --domain for anything else.
std::vector<Side> parse_sides(const std::string& box);

/// Where u in [0,1] lies on a side: x, increasing in u, and dx/du.
///   finite : x = lo (1 - u) + hi u
///   lo:inf : x = lo + u / (1 - u); -inf:hi mirrored; -inf:inf : x = t / (1 - t^2), t = 2 u - 1 [PiessensEtAl83]
struct Placed {
  double x, slope;
};
Placed place_on(const Side& side, double u);

} // namespace carlo
