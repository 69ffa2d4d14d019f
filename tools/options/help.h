#pragma once
/// Texts of --help.

#include <options/subcommand.h>

#include <cstddef>
#include <string>
#include <vector>

namespace carlo {

/// The parts of a help text, for the terminal and for manual pages.
struct HelpPage {
  std::string summary, usage;        ///< "carlo render [OPTIONS] SCENE"
  std::vector<HelpEntry> examples;   ///< command lines with their effects
  std::vector<HelpSection> sections; ///< options by group, explanations, exit codes
};
HelpPage help_page(const Subcommand& subcommand);
/// The help of carlo as a whole.
HelpPage help_page(const std::vector<Subcommand>& subcommands);

/// `carlo NAME --help`: usage, examples, options by group, further sections, exit codes, at most `columns` wide.
std::string help_of(const Subcommand& subcommand, std::size_t columns);

/// `carlo --help`.
std::string help_of(const std::vector<Subcommand>& subcommands, std::size_t columns);

/// The one-sentence description of carlo.
extern const char* const carlo_summary;

} // namespace carlo
