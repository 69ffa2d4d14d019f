#pragma once
// Sample files drawn by tests, and options that read them.

#include <tools/run_in_process.h>

#include <support/files.h>

#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <cmath>
#include <string>

struct SamplesFile : support::ScratchTest {
  static constexpr int n = 40'000;

  // Writes n rows of the text that draw() returns, in a common print format.
  template <class Draw> std::string samples(Draw draw, const std::string& name = "s.csv", int rows = n) const {
    mc::Pcg random(7);
    std::string text = "# drawn by a test\n";
    for (int i = 0; i < rows; ++i) text += draw(random) + "\n";
    return write(name, text);
  }
  // Writes a grid with rows of cell means.
  template <class Mean> std::string grid(int width, int height, Mean mean) const {
    std::string text;
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) text += fmt::format("{:.9g}{}", mean(i, j), i + 1 < width ? "," : "\n");
    return write("p.csv", text);
  }
  carlo::ValidateCommandOptions options(const std::string& samples, const std::string& pdf) const {
    carlo::ValidateCommandOptions o;
    o.samples_file = samples;
    o.pdf_file = pdf;
    return o;
  }
};

// x with density 2 x, y uniform.
inline std::string ramp(mc::Pcg& random) {
  const double x = std::sqrt(random.uniform<double>());
  return fmt::format("{:.6f},{:.6f}", x, random.uniform<double>());
}
// A cosine lobe about +z.
inline std::string cosine(mc::Pcg& random) {
  const double u = random.uniform<double>(), phi = 2 * mc::pi<double> * random.uniform<double>();
  return fmt::format("{:.7g} {:.7g} {:.7g}", std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi),
                     std::sqrt(1 - u));
}
