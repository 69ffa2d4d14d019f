#pragma once
/// The page of carlo validate, filled from a template.

#include <mc/check/report/report.h>

#include <string>
#include <string_view>

namespace carlo {

/// A kd-tree of cells as text.
struct PackedTree {
  std::string axes; ///< one digit per inner node, in heap order
  /// Base64 of 32-bit floats: the split of each inner node in heap order, then the observed and the expected counts.
  std::string numbers;
};

/// Returns the cells of the evidence, with neighbours joined until at most `most` remain.
PackedTree pack_tree(const mc::PlotData& evidence, int dim, std::size_t most);

/// Returns the observed and expected counts of the outcomes, with neighbours joined until at most `most` remain, as
/// base64 of 32-bit floats.
std::string pack_outcomes(const mc::PlotData& evidence, std::size_t most);

/// Returns one HTML file without external resources. `data` is the JSON of validation_json, with evidence.
std::string fill_page_template(std::string_view data);

} // namespace carlo
