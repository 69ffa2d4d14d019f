#pragma once
/// Plots by gnuplot.

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// Runs the script NAME.gp of the folder with kind = "svg" and kind = "png", and moves the complete pictures NAME.svg
/// and NAME.png to the folder. The script refers to its `data`, files of the folder, by name only. It runs in a
/// temporary folder with links to these files, so that nothing else in the user's folder changes. Returns whether
/// gnuplot is installed; if not, pictures of an earlier run are removed.
///   throws : Error if gnuplot fails, if a picture is incomplete, or if the folder is not writable.
bool draw_plot(const std::filesystem::path& folder, const std::string& name, const std::vector<std::string>& data);

/// Removes NAME.svg and NAME.png of an earlier run.
void remove_plot(const std::filesystem::path& folder, const std::string& name);

/// Returns the first lines of a script: the terminal of `kind`, the output NAME.kind of width x height pixels, and the
/// common style of all plots.
std::string plot_header(const std::string& name, int width, int height);

} // namespace carlo
