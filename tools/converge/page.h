#pragma once
/// Measured curves of integrals and scenes as one page that needs no network and no script.

#include <converge/picture_measurement.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// A measured target of a page.
struct PageEntry {
  const IntegralTarget* target;
  const Measurement* measurement;
  const PictureMeasurement* pictures = nullptr; ///< of a scene: whose measurement it is
  const TradeResults* trade_results = nullptr;  ///< of carlo trade
};

/// What carlo converge or carlo trade says of itself on top of the page.
struct PageHeader {
  std::string_view tool, title;
  std::string command;
};
PageHeader converge_header(const std::string& command);
PageHeader trade_header(const std::string& command);

/// Writes FOLDER/index.html: for each target what was asked for and the way to it; error against N and against what it
/// costs, with 95 % bands and dotted lines of theory; a table of every curve. Of a scene the reference and a picture of
/// each way, which are PNG files beside it.
void write_convergence_page(const std::filesystem::path& folder, const PageHeader& head,
                            const std::vector<PageEntry>& all);

/// The name of a file that is about `text`: its letters and digits, at most 60 of them.
std::string safe_file_name(const std::string& text);

} // namespace carlo
