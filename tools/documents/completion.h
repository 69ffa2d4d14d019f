#pragma once
/// Completion of command lines in shells, from the tables of options.

#include <options/subcommand.h>

#include <string>
#include <vector>

namespace carlo {

/// For bash: a function for `complete -F`.
std::string bash_completion(const std::vector<Subcommand>& subcommands);
/// For zsh: the autoloaded function _carlo.
std::string zsh_completion(const std::vector<Subcommand>& subcommands);
/// For fish: one line an option.
std::string fish_completion(const std::vector<Subcommand>& subcommands);

} // namespace carlo
