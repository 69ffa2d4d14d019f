#pragma once
/// Statistical tests of anything that draws points with a claimed density.

#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/options.h>
#include <mc/check/subject/subject.h>

namespace mc {

/// Draws samples and tests them:
///   per sample : the sample is finite and in the domain, its pdf is positive and finite, a stated weight is f / pdf.
///                Failures occur only if the subject may fail.
///   mass       : the claimed density and the atoms integrate to 1; to at most 1 if the subject may fail. The integral
///                comes from cubature if random points and samples agree with it. Its error then includes the mass that
///                4.6 samples would miss. Otherwise the integral and its error come from the random points.
///   tests      : every row of table.h that applies, each with its share of alpha. The variance of the expected counts
///                (stratified_reference.h) is part of the tests, so that no density makes a correct sampler fail.
/// The report states the smallest errors of the density that are detected with probability .99.
///   throws     : Error if samples < 1000, or if alpha is not in (0, 1).
Report check_subject(const Subject& subject, const SubjectOptions& options = {});

/// Memory that check_subject needs for two dimensions or three [bytes]; one dimension needs less. It is bounded for any
/// number of samples.
double check_memory(std::uint64_t samples);

/// Returns the number of samples with which check_subject detects a relative error `error` of the density, of random
/// sign (see Report), with probability .99. `alpha` is family-wise, `dim` is the dimension of the chart; more
/// dimensions need more samples. Throws Error unless error > 0 and 0 < alpha < 1.
std::uint64_t samples_to_detect(double error, double alpha, int dim = 3);

} // namespace mc
