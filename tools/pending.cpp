// Subcommands that have not landed yet; each leaves this file with the commit that brings it.
#include "commands.h"

#include <mc/core/error.h>

namespace carlo {

int converge(const ConvergeOptions&) { throw mc::Error("converge: not built yet"); }
int integrate(const IntegrateOptions&) { throw mc::Error("integrate: not built yet"); }

} // namespace carlo
