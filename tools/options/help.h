#pragma once
/// Texts of --help.

#include <options/subcommand.h>

#include <cstddef>
#include <string>
#include <vector>

namespace carlo {

/// `carlo NAME --help`: usage, examples, options by group, further sections, exit codes, at most `columns` wide.
std::string help_of(const Subcommand& subcommand, std::size_t columns);

/// `carlo --help`.
std::string help_of(const std::vector<Subcommand>& subcommands, std::size_t columns);

/// The one-sentence description of carlo.
extern const char* const carlo_summary;

} // namespace carlo
