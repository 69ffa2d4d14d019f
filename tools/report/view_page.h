#pragma once
/// The page on which a picture is looked at: zoom, exposure, channels, and values of pixels with their intervals.

#include <render/film/image.h>

#include <string>
#include <utility>
#include <vector>

namespace carlo {

/// State of a render that goes on.
struct ViewProgress {
  std::string text;                              ///< "12 of 64 samples per pixel, about 20 s remain"
  double fraction = 0;                           ///< share of the work that is done
  std::vector<std::pair<double, double>> errors; ///< time [s] and mean relative standard error
  bool is_running = true;                        ///< The page loads itself again every two seconds.
};

/// A page of one picture, or of two of the same size.
struct ViewPage {
  std::string tool;                                                   ///< "carlo view"
  std::string title;                                                  ///< what the page is about
  std::string command = {};                                           ///< the command that wrote the page
  std::string verdict = {};                                           ///< what a comparison found
  std::vector<std::pair<std::string, const render::Image*>> pictures; ///< names, and pictures that outlive this
  int x = 0, y = 0;                       ///< the upper left pixel's place in a larger picture
  double exposure = 0;                    ///< at the start [stops]
  const ViewProgress* progress = nullptr; ///< null: the render is finished
};

/// The page: one HTML file with its script and its data, for browsers from 2023 on. It loads nothing from the network.
/// Pictures with variances have 95 % intervals, see render::interval_half_widths().
std::string to_html(const ViewPage& page);

/// Throws Error for a picture of more pixels than a browser can show, or than the memory allows; names the remedy.
void require_viewable(const std::string& name, const render::Image& image, const std::string& remedy);

} // namespace carlo
