#pragma once
/// Checks samples from a file against a density or probabilities given as an expression.

#include <input/samples_file.h>

namespace carlo {

/// The file's samples as one case.
///   samples : one in each row, with the columns of the domain, see parse_domain.
///   density : an expression in the names of the columns, with respect to length, area, volume or solid angle, or their
///             product. For outcomes it is the probability of i; alternatively --pdf-file lists the probabilities in
///             order.
///   method  : as for a sampler of libmc. A printed number stands for all numbers that round to it, so each is moved by
///             less than half of its last digit. The offset is random and depends on the seed.
///   throws  : Error for a file that is missing or broken ("s.csv:17: ..."), fewer than 2000 samples, a sample outside
///             of the domain, an expression that does not parse, or a density that is positive nowhere.
SamplesFileCase samples_density_case(const SamplesFileOptions& options);

} // namespace carlo
