#pragma once
/// The option --memory of subcommands whose own memory may be large.

#include <options/subcommand.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>

#include <algorithm>

namespace carlo {

inline constexpr const char* memory_help =
    "Most memory for carlo, in GiB; work that needs more is refused before it begins. Default: half of the machine's.";

inline Option memory_option(std::optional<double>& gib) { return {"--memory", "GIB", &gib, memory_help}; }

/// Whether a subcommand has memory_option(). The option --memory of foreign code limits other processes.
inline bool has_memory_option(const Subcommand& subcommand) {
  return std::any_of(subcommand.options.begin(), subcommand.options.end(),
                     [](const Option& o) { return o.help == memory_help; });
}

/// Sets the limit of this process, if there is one. Throws Error for a limit that is not in (0, 1e6] GiB.
inline void limit_memory(const std::optional<double>& gib) {
  if (!gib) return;
  mc::require(*gib > 0 && *gib <= 1e6, "--memory {} must lie in (0, 1e6] GiB", *gib);
  mc::limit_memory(*gib * 0x1p30);
}

} // namespace carlo
