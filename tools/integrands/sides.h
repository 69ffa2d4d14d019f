#pragma once
/// Boxes on the command line.

#include <string>
#include <vector>

namespace carlo {

/// A variable with its bounds, lo < hi.
struct Side {
  std::string name;
  double lo, hi;
};

/// "x=0:1,y=-1:2". Throws Error that names --domain for anything else.
std::vector<Side> parse_sides(const std::string& box);

} // namespace carlo
