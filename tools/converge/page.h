#pragma once
/// Measured curves of integrals and scenes as one HTML page without network access or scripts.

#include <converge/picture_measurement.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// A measured target of a page.
struct PageEntry {
  const IntegralTarget* target;
  const Measurement* measurement;
  const PictureMeasurement* pictures = nullptr; ///< set for a scene
  const TradeResults* trade_results = nullptr;  ///< set for carlo trade
};

/// The name, title and command line at the top of the page.
struct PageHeader {
  std::string_view tool, title;
  std::string command;
};
PageHeader converge_header(const std::string& command);
PageHeader trade_header(const std::string& command);

/// Writes FOLDER/index.html. For each target the page shows the requested goals with the recommended methods. It plots
/// the error against N and against cost, with 95 % bands and dotted lines for the theory. A table lists every curve.
/// For a scene it adds the reference and one picture for each method, as PNG files in the same folder.
void write_convergence_page(const std::filesystem::path& folder, const PageHeader& head,
                            const std::vector<PageEntry>& all);

/// A file name made of `text`: the first 60 characters, with all but letters, digits, _ and - replaced by _.
std::string safe_file_name(const std::string& text);

} // namespace carlo
