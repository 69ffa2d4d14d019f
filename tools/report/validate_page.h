#pragma once
/// The page of carlo validate: its template with the data put in.

#include <mc/check/report/report.h>

#include <string>
#include <string_view>

namespace carlo {

/// A kd-tree of cells as text.
struct PackedTree {
  std::string axes; ///< one digit per inner node, in heap order
  std::string
      numbers; ///< base64 of 32-bit floats: a split per inner node in heap order, the observed and the expected counts
};

/// The cells of the evidence, neighbours joined until at most `most` remain.
PackedTree pack_tree(const mc::PlotData& evidence, int dim, std::size_t most);

/// Observed and expected counts of the outcomes, neighbours joined until at most `most` remain: base64 of 32-bit
/// floats.
std::string pack_outcomes(const mc::PlotData& evidence, std::size_t most);

/// One HTML file with everything inline. `data` is JSON, see validate_output.h.
std::string fill_page_template(std::string_view data);

} // namespace carlo
