#pragma once
/// Measured curves drawn as SVG.

#include <converge/trade.h>

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// What a panel draws the errors against.
struct PanelOptions {
  std::string_view axis; ///< what stands below it
  double (*x)(const mc::RmsError& e);
  bool theory = false;                        ///< dotted lines that fall as theory says
  std::vector<TradeCandidate> pareto_front{}; ///< a broad line through these, which x must be the seconds for
};

/// An SVG element: the RMS errors with their 95 % bands, both axes logarithmic; empty where no error is above 0.
std::string error_panel(const std::vector<ConvergenceCurve>& curves, const PanelOptions& options);

} // namespace carlo
