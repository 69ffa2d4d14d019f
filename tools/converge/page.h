#pragma once
/// Measured curves as one page that needs no network and no script.

#include <converge/measure.h>

#include <string>
#include <vector>

namespace carlo {

/// A measured target of a page.
struct Measured {
  const Target* target;
  const Measurement* measurement;
};

/// HTML with its pictures in it: for each target error against N and against CPU seconds, with 95 % bands and dotted
/// lines of theory, and a table of every curve.
std::string convergence_page(const std::vector<Measured>& all, const std::string& command);

} // namespace carlo
