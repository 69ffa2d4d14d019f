#pragma once
/// Every distribution of libmc and librender with the parameters at which it is checked.
///
/// A family adds its distributions in a file of its own, one line per case:
///   void add_spheres(Catalogue& c) {
///     add_warp(c, "CosineHemisphere", "", [](auto s) { return mc::CosineHemisphere<decltype(s)>{}; });
///   }
/// then declares that function below, calls it in catalogue.cpp, names the file in CMakeLists.txt, and adds a sentence
/// to descriptions.cpp. add_warp of warp_case.h makes a float and a double case of the line, add_bsdf of bsdf_case.h
/// one case per direction. The test catalogue_test.cpp fails when a warp, table, BSDF, shape, filter or camera of the
/// headers is not in the list, or has no description.

#include <mc/check/check_subject.h>

#include <functional>
#include <string>
#include <vector>

namespace carlo {

using CaseOptions = mc::SubjectOptions;

/// One distribution at one set of parameters over one scalar.
struct Case {
  std::string name;       ///< the type's name
  std::string parameters; ///< "alpha=0.1, theta=60"; empty without any
  std::string scalar;     ///< "float" or "double"
  std::function<mc::Report(const CaseOptions&)> check;
  std::string rerun_arguments = {}; ///< what follows "carlo validate" to check it alone; empty: its name

  /// "Linear(a=0, b=1)".
  std::string label() const { return name + (parameters.empty() ? "" : "(" + parameters + ")"); }
  std::string title() const { return label() + " " + scalar; }
};

using Catalogue = std::vector<Case>;

/// All cases, families in order.
const Catalogue& catalogue();

void add_intervals(Catalogue& c);
void add_planes(Catalogue& c);
void add_spheres(Catalogue& c);
void add_lobes(Catalogue& c);
void add_lights(Catalogue& c);
void add_tables(Catalogue& c);
void add_bsdfs(Catalogue& c);
void add_shapes(Catalogue& c);

} // namespace carlo
