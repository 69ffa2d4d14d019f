#pragma once
/// Known-wrong samplers, densities, weights and estimators, each with the right one beside it.
///
/// They stand here in our own words because two readers need them: `carlo slips`, which tells what the
/// checkers make of the code that the books print, and the tests, which demand that every one of them is rejected.
/// A family adds its slips in a file of its own, known_bugs/FAMILY.cpp.

#include <catalogue/catalogue.h>

#include <mc/check/report/report.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace carlo {

/// A sampler, weight or estimator ready to be judged; made by the functions of test_cases.h.
struct TestCase {
  std::function<mc::Report(const CaseOptions&)> check;
  /// Draws of a stream until one shows by itself that it is wrong (not finite, outside, density 0, weight off); 0 when
  /// none of the first `most` does.
  std::function<std::uint64_t(std::uint64_t seed, std::uint64_t most)> first_failure;
  std::uint64_t min_samples = 1000; ///< samples that `check` needs
};

/// One slip. The numbers P1 to P36 are those of the books and courses, in the order of their lists; R1 ... were shipped
/// by renderers; C1 ... and V1 ... are small disturbances of a cosine lobe and of visible normals.
struct KnownBug {
  std::string id;
  std::string name;
  std::string source;      ///< the text or program it was found in
  std::string description; ///< what is wrong, and what is right; one line
  mc::Fault fault;         ///< the first law it breaks
  std::uint64_t samples;   ///< with which it is rejected at alpha = 1 %, for any seed
  TestCase wrong, right;

  std::string title() const { return id + " " + name; }
};

using KnownBugs = std::vector<KnownBug>;

KnownBugs book_bugs();     ///< P1 to P36
KnownBugs renderer_bugs(); ///< R1 ...
KnownBugs perturbations(); ///< C1 ..., V1 ...

/// All three families.
KnownBugs all_known_bugs();

/// Where the books' numbers live: appended to `s` by books.cpp and courses.cpp.
void add_shirley(KnownBugs& s);
void add_courses(KnownBugs& s);

} // namespace carlo
