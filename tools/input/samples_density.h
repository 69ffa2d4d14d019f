#pragma once
/// Samples drawn by anything, against a density or probabilities as an expression.

#include <input/samples_file.h>

namespace carlo {

/// The file's samples as one case.
///   samples : a row each, the columns of the domain, see parse_domain
///   density : an expression in the names of the columns, against length, area, volume or solid angle, or their
///             product. Of outcomes: the probability of i; or --pdf-file, the probabilities in its order
///   method  : as with a sampler of libmc; but a printed number stands for all that round to it, so each is moved by
///             less than half of its last digit, at random by the seed
///   throws  : Error for a file that is missing or broken ("s.csv:17: ..."), fewer than 2000 samples, a sample off the
///             domain, an expression that does not parse, or a density that is nowhere positive
SamplesFileCase samples_density_case(const SamplesFileOptions& options);

} // namespace carlo
