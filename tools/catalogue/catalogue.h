#pragma once
/// Every distribution of libmc and librender with the parameters for which it is checked.
///
/// A family adds its distributions in its own file. Each line adds one distribution with its parameters, for example.
///   void add_spheres(Catalogue& c) {
///     add_warp(c, "CosineHemisphere", "", [](auto s) { return mc::CosineHemisphere<decltype(s)>{}; });
///   }
///
/// To add a family, declare this function below, call it in catalogue.cpp, and name the file in CMakeLists.txt. Each
/// distribution needs a sentence in descriptions.cpp. add_warp of warp_case.h adds a float and a double case for the
/// line, add_bsdf of bsdf_case.h one case for each direction. The test catalogue_test.cpp fails if a warp, table, BSDF,
/// shape, filter or camera of the headers is not listed or not described.

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
  std::string rerun_arguments = {}; ///< arguments of "carlo validate" that select this case; empty: its name

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
