#pragma once
/// Wrong samplers, densities, weights and estimators, each paired with a correct version.
///
/// They are reimplemented here for two users. `carlo known-bugs` shows which checks reject the code that the books
/// print. The tests require that every one of them is rejected. A family adds its bugs in its own file,
/// known_bugs/FAMILY.cpp.

#include <catalogue/catalogue.h>

#include <mc/check/report/report.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// A sampler, weight or estimator that can be checked; created by the functions of test_cases.h.
struct TestCase {
  std::function<mc::Report(const CaseOptions&)> check;
  /// Draws from a stream until one sample is wrong by itself: not finite, outside, density 0, or wrong weight. Returns
  /// the number of draws; 0 if none of the first `most` is wrong.
  std::function<std::uint64_t(std::uint64_t seed, std::uint64_t most)> first_failure;
  std::uint64_t min_samples = 1000; ///< samples that `check` needs
};

/// One bug. P1 to P36 are from the books and courses, in the order of their lists. R1 ... were shipped by renderers. C1
/// ... and V1 ... are small perturbations of a cosine lobe and of visible normals.
struct KnownBug {
  std::string id;
  std::string name;
  std::string source;      ///< text or program that contains it
  std::string description; ///< the error and its correction in one line
  mc::Fault fault;         ///< the first law that it breaks
  std::uint64_t samples;   ///< sample count that rejects it at alpha = 1 %, for any seed
  TestCase wrong, right;

  std::string title() const { return id + " " + name; }
};

using KnownBugs = std::vector<KnownBug>;

KnownBugs book_bugs();     ///< P1 to P36
KnownBugs renderer_bugs(); ///< R1 ...
KnownBugs perturbations(); ///< C1 ..., V1 ...

/// All three families.
KnownBugs all_known_bugs();

/// Append the bugs of the books and courses to `s`; defined in books.cpp and courses.cpp.
void add_shirley(KnownBugs& s);
void add_courses(KnownBugs& s);

} // namespace carlo
