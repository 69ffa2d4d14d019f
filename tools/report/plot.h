#pragma once
/// Pictures by gnuplot.

#include <filesystem>
#include <string>

namespace carlo {

/// Runs the script NAME.gp of the folder with kind = "svg", then with kind = "png", in that folder, so that it names
/// its data without one. Returns whether gnuplot is installed.
///   throws : Error when gnuplot fails; what it said is in NAME.log
bool draw_plot(const std::filesystem::path& folder, const std::string& name);

/// Where a script begins: sets the terminal of `kind`, the output NAME.kind of width x height pixels, and the looks
/// that all pictures share.
std::string plot_head(const std::string& name, int width, int height);

} // namespace carlo
