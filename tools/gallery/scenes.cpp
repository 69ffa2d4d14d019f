#include <gallery/scenes.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <array>
#include <filesystem>
#include <vector>

namespace carlo {

namespace {

constexpr std::string_view ours = "ours";

// Members that a row omits have the defaults of carlo render.
constexpr auto scenes = std::to_array<GalleryScene>({
    // P. Shirley, Ray Tracing in One Weekend
    {"book1-gradient", "Gradient: red and green grow along the axes", "P. Shirley, In One Weekend, ch. 1"},
    {"book1-sky", "Sky from white to blue", "P. Shirley, In One Weekend, ch. 2"},
    {"book1-red-sphere", "Red sphere, one ray per pixel", "P. Shirley, In One Weekend, ch. 3"},
    {"book1-normals", "Normals as colours, one ray per pixel", "P. Shirley, In One Weekend, ch. 4"},
    {"book1-antialiased", "Normals as colours, antialiased", "P. Shirley, In One Weekend, ch. 5"},
    {"book1-diffuse", "Diffuse spheres that reflect half of the light", "P. Shirley, In One Weekend, ch. 6"},
    {"book1-metal", "Metal spheres without fuzz", "P. Shirley, In One Weekend, ch. 7"},
    {"book1-fuzzy-metal", "Fuzzy metal spheres", "P. Shirley, In One Weekend, ch. 7"},
    {"book1-glass", "Glass sphere", "P. Shirley, In One Weekend, ch. 8"},
    {"book1-hollow-glass", "Hollow glass sphere", "P. Shirley, In One Weekend, ch. 8"},
    {"book1-wide", "Two spheres, field of view of 90 degrees", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-distant", "Spheres from far away", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-zoomed", "Spheres from far away, zoomed in", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-defocus", "Depth of field", "P. Shirley, In One Weekend, ch. 10"},
    {"book1-cover", "Cover: 487 spheres", "P. Shirley, In One Weekend, cover"},

    // P. Shirley, The Rest of Your Life
    {"book3-cornell-first", "Cornell box with a two-sided light, cosine directions",
     "P. Shirley, The Rest of Your Life, ch. 4", "book3-cornell-first", "bsdf"},
    {"book3-cornell-hemisphere", "Cornell box with a two-sided light, uniform directions",
     "P. Shirley, The Rest of Your Life, ch. 4", "book3-cornell-first", "hemisphere"},
    {"book3-cornell-light", "Cornell box, directions to the light only; indirect light is missing",
     "P. Shirley, The Rest of Your Life, ch. 7", "book3-cornell-first", "light"},
    {"book3-cornell-light-down", "Cornell box with a one-sided light, directions to the light only",
     "P. Shirley, The Rest of Your Life, ch. 7", "book3-cornell-white", "light"},
    {"book3-cornell-cosine", "Cornell box with a one-sided light, cosine directions",
     "P. Shirley, The Rest of Your Life, ch. 8", "book3-cornell-white", "bsdf"},
    {"book3-cornell-white", "Cornell box with a one-sided light, mixture of both",
     "P. Shirley, The Rest of Your Life, ch. 8", "book3-cornell-white", "mixture"},
    {"book3-cornell-aluminium", "Cornell box with an aluminium block", "P. Shirley, The Rest of Your Life, ch. 10",
     "book3-cornell-aluminium", "mixture"},
    {"book3-cornell-glass-sphere-only", "Glass sphere in a Cornell box, half of the directions aim at the sphere",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass-guided", "guides", "", 1.5},
    {"book3-cornell-glass-guided", "Glass sphere in a Cornell box, mixture aims at the sphere and the light",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass-guided", "mixture", "", 1.5},
    {"book3-cornell-glass-mis", "Glass sphere in a Cornell box, paths from the camera only",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass", "mis", "", 1.5},
    {"book3-cornell-glass", "Glass sphere in a Cornell box, paths from the camera and the light",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass", "", "", 1.5},
    {"book3-pixels-random", "Cornell box, 64 random samples per pixel",
     "P. Shirley, The Rest of Your Life, later edition", "book3-cornell-first", "bsdf", "independent", 0, 64},
    {"book3-pixels-stratified", "Cornell box, 64 samples per pixel, stratified in 32 boxes",
     "P. Shirley, The Rest of Your Life, later edition", "book3-cornell-first", "bsdf", "stratified", 0, 64},

    // K. Beason's 99 lines, and the lecture that explains them
    {"smallpt", "Mirror and glass spheres in a room whose walls are spheres", "K. Beason, smallpt"},
    {"smallpt-naive", "smallpt without connections to the light", "K. Beason, smallpt", "smallpt", "bsdf"},
    {"smallpt-nee", "smallpt with connections to the light only", "K. Beason, smallpt", "smallpt", "nee"},

    // Scenes of lajolla's document, and one scene of our own for each of its figures
    {"cbox", "Cornell box with measured spectra", "Cornell Program of Computer Graphics, from Mitsuba", "cbox", "", "",
     1},
    {"veach-mi", "Plates of four roughnesses, lights of five sizes", "E. Veach, from lajolla"},
    {"sphere-light", "Spherical light above a floor", ours},
    {"arcade", "Courtyard with arches", ours, "arcade", "", "", -1},
    {"materials", "Knots of diffuse paint, rough plastic and rough glass", ours, "materials", "", "", -0.5},
    {"filter-box", "Checkerboard to the horizon, box filter", ours},
    {"filter-tent", "Checkerboard to the horizon, tent filter", ours},
    {"filter-gaussian", "Checkerboard to the horizon, Gaussian filter", ours},
    {"textures", "Polished marble floor, tiled wall", ours},
    {"ground-glass", "Rough glass, smooth glass and glossy paint under a sky", ours, "ground-glass", "", "", -2},
    {"mesh-formats", "Torus and trefoil knot", ours},
    {"globe", "Textured globe and tiled box under an evening sky", ours},
    {"show-case", "Metal, ground glass and paint with Beckmann facets behind thin panes", ours},

    // Stages of real-time ray tracing courses, in a room of our own
    {"hard-shadows", "Room lit by two point lights and the sun", ours},
    {"coloured-shadows", "Red, green and blue spot lights on a white stage with a glass ball", ours},
    {"fog", "Spot lights in fog, a cloud, green smoke and a stone", ours},
    {"worn", "Paint, glass and gold that are rough in places", ours},
    {"fast-lens", "Room through a lens of f/1.4", ours},
    {"ambient-occlusion", "Room with ambient occlusion", ours},
    {"one-bounce", "Room under a sky, one bounce, filmic tone curve", ours, "one-bounce", "", "", 1, 0,
     render::ToneCurve::filmic},
    {"leaves", "Plant with masked leaves, lattice and veil", ours},
    {"metals", "Metals and glossy paint", "C. Wyman, DXR tutorials"},
    {"tinted-glass", "Green glass with absorption", "M. McGuire, The Graphics Codex"},
    {"blinn-phong", "Blinn-Phong highlights", "M. McGuire, The Graphics Codex"},
});

} // namespace

std::span<const GalleryScene> gallery() { return scenes; }

const GalleryScene& gallery_scene(std::string_view name) {
  std::vector<std::string_view> names;
  for (const GalleryScene& scene : scenes) {
    if (scene.name == name) return scene;
    names.push_back(scene.name);
  }
  throw mc::Error(fmt::format("the gallery has no scene '{}'{}; carlo gallery --list shows them", name,
                              mc::did_you_mean(name, names)));
}

std::string scene_file(const GalleryScene& scene) {
  namespace fs = std::filesystem;
  const std::string file = fmt::format("{}.xml", scene.file.empty() ? scene.name : scene.file);
  std::error_code unknown;
  const fs::path installed = fs::read_symlink("/proc/self/exe", unknown).parent_path() / CARLO_SCENES_FROM_PROGRAM;
  const fs::path in_project = CARLO_SCENES_OF_PROJECT;
  for (const fs::path& folder : {installed, in_project})
    if (fs::exists(folder / file)) return (folder / file).lexically_normal().string();
  throw mc::Error(fmt::format("{} is neither in {} nor in {}; install carlo with its scenes", file,
                              installed.lexically_normal().string(), in_project.string()));
}

} // namespace carlo
