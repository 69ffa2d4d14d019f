#pragma once
/// The page of a render, kept fresh while it runs.

#include <report/view_page.h>

#include <render/render.h>

#include <chrono>
#include <filesystem>
#include <string>

namespace carlo {

/// index.html in a folder, with the picture so far, the error against time, and what remains.
///   time : a page is written at most every two seconds, and takes at most a twentieth of the render's time.
class RenderReport {
 public:
  /// Makes the folder.
  ///   throws : Error where the page cannot be written.
  RenderReport(const std::filesystem::path& folder, std::string scene, std::string command, const render::Crop& part);

  /// Writes the page if it is due. For RenderOptions::progress. A page that cannot be written is skipped.
  void show(const render::Progress& progress);
  /// Writes the page of the finished or ended render.
  void finish(const render::RenderResult& result);

 private:
  using Clock = std::chrono::steady_clock;

  void write(const render::Image& image, double seconds, double error);

  std::filesystem::path file_;
  ViewPage page_;
  ViewProgress progress_;
  Clock::time_point next_ = Clock::now();
};

} // namespace carlo
