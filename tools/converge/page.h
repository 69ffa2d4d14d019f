#pragma once
/// The page of carlo converge and carlo trade. It needs no network and no script.

#include <converge/picture_measurement.h>
#include <terminal/result_writer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// A measured target of a page.
struct PageEntry {
  const IntegralTarget* target;
  const Measurement* measurement;
  const PictureMeasurement* pictures = nullptr; ///< of a scene, with its measurement
  const TradeResults* trade_results = nullptr;  ///< of carlo trade
};

/// Title of a page, and the command that wrote it.
struct PageHeader {
  std::string_view tool, title;
  std::string command;
};
PageHeader converge_header(const std::string& command);
PageHeader trade_header(const std::string& command);

/// Writes FOLDER/index.html, with a section for each target. It contains the answer in sentences and a table (carlo
/// trade), and a table of all curves. Plots show the error against N and against its cost, with 95 % bands and the
/// slopes of theory. For a scene, the reference and a picture of each method are PNG files beside the page.
void write_convergence_page(ResultWriter& results, const std::filesystem::path& folder, const PageHeader& head,
                            const std::vector<PageEntry>& all);

/// A file name made of `text`: at most 60 characters, all but letters, digits, _ and - replaced by _.
std::string safe_file_name(const std::string& text);

} // namespace carlo
