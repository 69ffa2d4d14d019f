#pragma once
/// Measured curves of integrals and scenes as one page that needs no network and no script.

#include <converge/pictures.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// A measured target of a page.
struct Measured {
  const Target* target;
  const Measurement* measurement;
  const Pictures* pictures = nullptr; ///< of a scene: whose measurement it is
  const Answers* answers = nullptr;   ///< of carlo trade
};

/// What carlo converge or carlo trade says of itself on top of the page.
struct PageHead {
  std::string_view tool, title;
  std::string command;
};
PageHead converge_head(const std::string& command);
PageHead trade_head(const std::string& command);

/// Writes FOLDER/index.html: for each target what was asked for and the way to it; error against N and against what it
/// costs, with 95 % bands and dotted lines of theory; a table of every curve. Of a scene the reference and a picture of
/// each way, which are PNG files beside it.
void write_page(const std::filesystem::path& folder, const PageHead& head, const std::vector<Measured>& all);

/// The name of a file that is about `text`: its letters and digits, at most 60 of them.
std::string file_name(const std::string& text);

} // namespace carlo
