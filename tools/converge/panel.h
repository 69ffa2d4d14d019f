#pragma once
/// Measured curves drawn as SVG.

#include <converge/trade.h>

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Axes and additional lines of a panel.
struct PanelOptions {
  std::string_view axis; ///< label of the x axis
  double (*x)(const mc::RmsError& e);
  bool theory = false;                        ///< draws dotted lines with the theoretical slope
  std::vector<TradeCandidate> pareto_front{}; ///< draws a broad line through these points; x must then return seconds
};

/// An SVG element with the RMS errors and their 95 % bands on logarithmic axes. Empty if no error exceeds 0.
std::string error_panel(const std::vector<ConvergenceCurve>& curves, const PanelOptions& options);

} // namespace carlo
