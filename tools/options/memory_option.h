#pragma once
/// The option --memory of subcommands that read pictures and meshes.

#include <options/subcommand.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>

namespace carlo {

inline Option memory_option(std::optional<double>& gib) {
  return {"--memory", "GIB", &gib,
          "Most memory for carlo, in GiB; a file that needs more is refused before it is read. Default: half of the "
          "machine's for each file."};
}

/// Sets the limit of this process, if there is one. Throws Error for a limit that is not in (0, 1e6] GiB.
inline void limit_memory(const std::optional<double>& gib) {
  if (!gib) return;
  mc::require(*gib > 0 && *gib <= 1e6, "--memory {} must lie in (0, 1e6] GiB", *gib);
  mc::limit_memory(*gib * 0x1p30);
}

} // namespace carlo
