#include <catalogue/descriptions.h>

#include <terminal/columns.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace carlo {

namespace {

struct Description {
  std::string_view name, text;
};

// In the order of the catalogue.
constexpr auto descriptions = std::to_array<Description>({
    {"UniformInterval", "Uniform on an interval"},
    {"Linear", "Density on [0,1] that is linear from a at 0 to b at 1"},
    {"Tent", "Triangle of a given radius about a centre"},
    {"Normal", "Normal distribution on the line"},
    {"Exponential", "Exponential distribution on the half line"},
    {"Hyperexponential", "Mixture of exponential distributions on the half line"},
    {"TrimmedExponential", "Exponential distribution cut to [0, length]; grows for a negative rate"},
    {"Logistic", "Logistic distribution on the line"},
    {"TrimmedLogistic", "Logistic distribution cut to an interval"},
    {"Smoothstep", "Density on [0,1] proportional to 3 x^2 - 2 x^3"},
    {"Power", "Density on [0,1] proportional to x^n"},
    {"UniformDisk", "Uniform on the unit disk, by the concentric map"},
    {"UniformDiskPolar", "Uniform on the unit disk, by polar coordinates"},
    {"UniformTriangle", "Uniform on the triangle x, y >= 0, x + y <= 1"},
    {"UniformAnnulus", "Uniform between two circles about the origin"},
    {"UniformParallelogram", "Uniform on a parallelogram in space"},
    {"Bilinear", "Density on the unit square, bilinear between values at its corners"},
    {"IsotropicNormal", "Normal distribution on the plane, by the polar map of Box and Muller"},
    {"UniformBox", "Uniform on an axis-parallel box"},
    {"Product", "Independent coordinates, each from its own distribution"},
    {"UniformSphere", "Uniform directions"},
    {"UniformHemisphere", "Uniform directions above a plane"},
    {"CosineHemisphere", "Directions above a plane with density cos(theta) / pi"},
    {"UniformCone", "Uniform directions within an angle [rad] of +z"},
    {"Mixture", "Two distributions of directions, one of which is chosen for each sample"},
    {"MixtureN", "A number of cones known at run time, one of which is chosen for each sample"},
    {"UniformBall", "Uniform in the unit ball"},
    {"UniformRotation", "Uniform rotations as unit quaternions"},
    {"Rotated", "A distribution of directions about another axis"},
    {"BlinnPhong", "Directions with density proportional to cos(theta)^n"},
    {"HenyeyGreenstein", "Scattering angles of a participating medium with mean cosine g"},
    {"VonMisesFisher", "Normal distribution on the sphere with concentration kappa"},
    {"BeckmannNormals", "Normals of rough surfaces: Gaussian slopes with roughness alpha"},
    {"BeckmannVisibleNormals", "The Beckmann normals that are visible from a direction"},
    {"TrowbridgeReitzNormals", "Normals of rough surfaces: Trowbridge-Reitz (GGX) with roughness alpha"},
    {"TrowbridgeReitzVisibleNormals", "The Trowbridge-Reitz normals that are visible from a direction"},
    {"Reflected", "Directions reflected about random normals"},
    {"RefractedIn", "Directions refracted into glass through random normals"},
    {"RefractedOut", "Directions refracted out of glass through random normals, with total reflection"},
    {"SphereLight", "Directions to a sphere, uniform in solid angle"},
    {"SphericalTriangle", "Directions to a triangle, uniform in solid angle"},
    {"SphericalRectangle", "Directions to a parallelogram, uniform in solid angle"},
    {"TableDist1D", "Piecewise constant density on an interval, or its cells as outcomes"},
    {"UniformDiscrete", "Equally likely outcomes"},
    {"Bernoulli", "One of two outcomes with probability p"},
    {"ShortDiscrete", "A few outcomes in proportion to their weights, by linear search"},
    {"TableDist2D", "Piecewise constant density on the unit square or, by solid angle, on the sphere"},
    {"TableDistTree", "Piecewise constant density on the boxes of a kd-tree"},
    {"AliasTable", "Outcomes in proportion to their weights, in constant time"},
    {"Lambert", "BSDF of a matte surface: the same radiance in all directions"},
    {"TexturedBsdf", "BSDF with colours or roughness from a picture"},
    {"FuzzyMetal", "BSDF of a mirror, or of a metal whose reflections are blurred by a ball of radius fuzz"},
    {"Dielectric", "BSDF of smooth glass: reflection and refraction by the Fresnel equations"},
    {"RoughPlastic", "BSDF of a diffuse base under a rough coating"},
    {"SmoothPlastic", "BSDF of a diffuse base under a smooth coating"},
    {"SmoothConductor", "BSDF of a smooth metal with a measured index of refraction"},
    {"RoughConductor", "BSDF of a rough metal of microfacets"},
    {"ThinDielectric", "BSDF of a pane of glass that is too thin to displace light"},
    {"PhaseFunction", "Henyey-Greenstein scattering in a medium, as integrators use it"},
    {"RoughDielectric", "BSDF of ground glass: microfacets that reflect and refract"},
    {"Sphere", "Points and directions of a sphere as seen from a point"},
    {"TriangleMesh", "Points and directions of a triangle mesh as seen from a point"},
    {"Cylinder", "Points and directions of a cylinder as seen from a point"},
    {"Disk", "Points and directions of a disk or an ellipse as seen from a point"},
    {"LightSampler", "The choice of one light of a scene, by its contribution at a point"},
    {"PointLight", "The choice of point lights, by their distance"},
    {"SpotLight", "The choice of spot lights, by their distance and their cones"},
    {"DirectionalLight", "The choice of a directional light among point lights"},
    {"Mask", "Whether a ray stops at a surface of partial opacity"},
    {"ConstantBackground", "Directions to a sky of constant radiance"},
    {"GradientBackground", "Directions to a sky whose radiance is linear in the height"},
    {"Environment", "Directions to an environment map, by the luminance of its pixels"},
    {"AreaLight", "Directions to a shape that emits light"},
    {"BoxFilter", "Offsets from the centre of a pixel: uniform in a square"},
    {"TentFilter", "Offsets from the centre of a pixel: a product of triangles"},
    {"GaussianFilter", "Offsets from the centre of a pixel: a Gaussian, cut at its radius"},
    {"SubpixelTentFilter", "Offsets from the centre of a pixel: triangles about the centres of n x n subpixels"},
    {"ThinLens", "Camera rays: points of the lens, and directions through the film"},
});

// Cases grouped by name, in the order of first appearance.
std::vector<std::vector<const Case*>> by_distribution(const std::vector<const Case*>& cases) {
  std::vector<std::vector<const Case*>> groups;
  for (const Case* c : cases) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g[0]->name == c->name; });
    if (same == groups.end()) groups.push_back({c});
    else same->push_back(c);
  }
  return groups;
}

constexpr std::size_t indent = 2, hang = 37;

} // namespace

std::string_view description_of(std::string_view name) {
  const auto found =
      std::find_if(descriptions.begin(), descriptions.end(), [&](const auto& d) { return d.name == name; });
  return found == descriptions.end() ? std::string_view() : found->text;
}

std::string distributions_text(const std::vector<const Case*>& cases, std::size_t columns) {
  std::string text = fmt::format("{:<29} {:>5}  {}\n", "distribution", "cases", "description");
  const auto groups = by_distribution(cases);
  for (const auto& group : groups)
    text += term_row(fmt::format("{:<29} {:>5}", group[0]->name, group.size()),
                     fmt::format("{}.", description_of(group[0]->name)), columns, 0, hang);
  return text + "\n" +
         wrapped(fmt::format("{} cases of {} distributions. carlo validate --list NAME shows the cases of one, which "
                             "carlo validate checks by name.",
                             cases.size(), groups.size()),
                 columns);
}

std::string cases_text(const std::vector<const Case*>& cases, std::size_t columns) {
  std::string text;
  for (const auto& group : by_distribution(cases)) {
    const std::string_view description = description_of(group[0]->name);
    if (!description.empty()) text += wrapped(fmt::format("{}: {}.", group[0]->name, description), columns);
    std::vector<std::pair<std::string, std::string>> rows; // case and scalars
    for (const Case* c : group) {
      if (!rows.empty() && rows.back().first == c->label()) rows.back().second += ", " + c->scalar;
      else rows.emplace_back(c->label(), c->scalar);
    }
    for (const auto& [name, scalars] : rows) text += fmt::format("{:{}}{:<60} {}\n", "", indent, name, scalars);
  }
  return text;
}

} // namespace carlo
