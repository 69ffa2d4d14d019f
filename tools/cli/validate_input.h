#pragma once
/// What carlo validate checks in place of the catalogue: a plugin, a program or a file of samples.

#include <catalogue/catalogue.h>
#include <cli/validate.h>

#include <atomic>
#include <cstdint>

namespace carlo {

/// The user's own code or samples as cases; none without them.
struct UserInput {
  Catalogue cases;
  std::uint64_t samples = 0; ///< number of samples of a file; 0: the option decides
};

/// Reads the user's code or samples. Prints how a file was thinned.
///   cancel : ends external code, see WorkerOptions.
///   throws : Error for options that exclude or need each other, and for code or files that cannot be used.
///            Interrupted if `cancel` becomes true.
UserInput read_user_input(const ValidateCommandOptions& options, const std::atomic<bool>* cancel);

} // namespace carlo
