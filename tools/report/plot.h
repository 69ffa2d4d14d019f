#pragma once
/// Pictures by gnuplot.

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// Runs the script NAME.gp of the folder with kind = "svg", then with kind = "png", and puts the pictures NAME.svg and
/// NAME.png into the folder once they are whole. The script names its `data`, files of the folder, without one; it runs
/// in a folder of its own that has links to them, so that nothing else in the user's is touched. Returns whether
/// gnuplot is installed; without it pictures of an earlier run go.
///   throws : Error when gnuplot fails or draws only a part, or the folder does not take the pictures
bool draw_plot(const std::filesystem::path& folder, const std::string& name, const std::vector<std::string>& data);

/// Removes NAME.svg and NAME.png, which an earlier run has left where this one has nothing to draw.
void remove_plot(const std::filesystem::path& folder, const std::string& name);

/// Where a script begins: sets the terminal of `kind`, the output NAME.kind of width x height pixels, and the looks
/// that all pictures share.
std::string plot_header(const std::string& name, int width, int height);

} // namespace carlo
