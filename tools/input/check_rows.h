#pragma once
/// Checks of samples that come in an order, such as the rows of a file.

#include <mc/check/check_subject.h>

#include <span>
#include <string>
#include <vector>

namespace carlo {

/// Samples in their order, as points of the unit cube or as discrete outcomes.
struct OrderedSamples {
  std::vector<mc::Subject::Coordinates> points; ///< of an outcome: its index and zeros
  std::vector<mc::Axis> axes;                   ///< meaning of the coordinates; one axis for outcomes
  int dim = 1;                                  ///< number of coordinates
  std::span<const double> probabilities = {};   ///< of the outcomes; empty for points
};

/// How a user accepts rows that depend on each other.
struct DependenceWords {
  std::string option = "--dependent", ///< says that they may
      remedy =
          "--thin auto keeps independent rows of a Markov chain, --dependent accepts a point set"; ///< after a fault
};

/// Returns check_subject with tests that the samples are independent: their order, and for outcomes the evenness of the
/// counts. The tests of the order and of evenness take a twentieth of alpha. With `dependent` the report lists them as
/// not tried.
mc::Report check_rows(const mc::Subject& subject, const OrderedSamples& samples, bool dependent,
                      const mc::SubjectOptions& options, const DependenceWords& words = {});

} // namespace carlo
