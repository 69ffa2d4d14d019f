// The committed table of single-scattering albedos, notebooks-data/single-scattering/albedo.csv.

#include <render/bsdf/rough_conductor.h>
#include <render/bsdf/rough_dielectric.h>
#include <render/bsdf/rough_plastic.h>

#include <mc/core/file.h>

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

double kept(const std::string& material, Float eta, Float alpha, double cosine) {
  const Spectrum one = Spectrum::Ones(), none = Spectrum::Zero();
  const int points = 4096;
  if (material == "metal ggx")
    return support::albedo(RoughConductor(none, one, TrowbridgeReitzFacets(alpha)), cosine, points);
  if (material == "metal phong")
    return support::albedo(RoughConductor(none, one, BlinnPhongFacets(alpha)), cosine, points);
  if (material == "white paint") return support::albedo(RoughPlastic(eta, alpha, one, one), cosine, points);
  const bool inside = material == "glass from inside";
  EXPECT_TRUE(inside || material == "glass from outside") << material;
  return support::albedo(RoughDielectric(eta, alpha), inside ? -cosine : cosine, points);
}

// At seven roughnesses the table matches the albedos of the materials, within the error of 4096 points. No albedo
// exceeds 1.
TEST(SingleScattering, TheTableIsTrue) {
  std::istringstream lines(mc::read_file(MC_SOURCE_DIR "/notebooks-data/single-scattering/albedo.csv"));
  std::string line, cell;
  std::getline(lines, line);
  std::vector<double> cosines;
  std::istringstream header(line);
  while (std::getline(header, cell, ','))
    if (cell.starts_with("cos=")) cosines.push_back(std::stod(cell.substr(4)));
  ASSERT_EQ(cosines.size(), 9u);
  std::set<std::string> materials;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    std::string material, eta, alpha;
    std::getline(std::getline(std::getline(row, material, ','), eta, ','), alpha, ',');
    materials.insert(material);
    for (const double cosine : cosines) {
      ASSERT_TRUE(std::getline(row, cell, ',')) << line;
      EXPECT_LE(std::stod(cell), 1.0003) << line;
      if (alpha == "0.0001" || alpha == "0.001" || alpha == "0.2" || alpha == "0.8") continue; // to save time
      EXPECT_NEAR(std::stod(cell), kept(material, Float(std::stod(eta)), Float(std::stod(alpha)), cosine), 0.01)
          << material << ' ' << eta << ' ' << alpha << ' ' << cosine;
    }
  }
  EXPECT_EQ(materials.size(), 5u);
}

} // namespace
