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
    {"book1-gradient", "Red and green grow along the axes", "P. Shirley, In One Weekend, ch. 1"},
    {"book1-sky", "A sky from white to blue", "P. Shirley, In One Weekend, ch. 2"},
    {"book1-red-sphere", "A red sphere, a ray for each pixel", "P. Shirley, In One Weekend, ch. 3"},
    {"book1-normals", "Normals as colours, a ray for each pixel", "P. Shirley, In One Weekend, ch. 4"},
    {"book1-antialiased", "Normals as colours, antialiased", "P. Shirley, In One Weekend, ch. 5"},
    {"book1-diffuse", "Diffuse spheres that reflect half of the light", "P. Shirley, In One Weekend, ch. 6"},
    {"book1-metal", "Mirrors", "P. Shirley, In One Weekend, ch. 7"},
    {"book1-fuzzy-metal", "Fuzzy metal", "P. Shirley, In One Weekend, ch. 7"},
    {"book1-glass", "Glass", "P. Shirley, In One Weekend, ch. 8"},
    {"book1-hollow-glass", "Hollow glass", "P. Shirley, In One Weekend, ch. 8"},
    {"book1-wide", "A field of view of 90 degrees", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-distant", "A view from afar", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-zoomed", "The same, zoomed in", "P. Shirley, In One Weekend, ch. 9"},
    {"book1-defocus", "Depth of field", "P. Shirley, In One Weekend, ch. 10"},
    {"book1-cover", "The cover: 487 spheres", "P. Shirley, In One Weekend, cover"},

    // P. Shirley, The Rest of Your Life
    {"book3-cornell-first", "Cornell box, its light shines to both sides", "P. Shirley, The Rest of Your Life, ch. 4",
     "book3-cornell-first", "bsdf"},
    {"book3-cornell-hemisphere", "The same by uniform directions", "P. Shirley, The Rest of Your Life, ch. 4",
     "book3-cornell-first", "hemisphere"},
    {"book3-cornell-light", "The same by directions to the light alone: what other surfaces reflect is missed",
     "P. Shirley, The Rest of Your Life, ch. 7", "book3-cornell-first", "light"},
    {"book3-cornell-light-down", "The light faces down; its directions alone",
     "P. Shirley, The Rest of Your Life, ch. 7", "book3-cornell-white", "light"},
    {"book3-cornell-cosine", "The light faces down; cosine directions", "P. Shirley, The Rest of Your Life, ch. 8",
     "book3-cornell-white", "bsdf"},
    {"book3-cornell-white", "The light faces down; a mixture of both", "P. Shirley, The Rest of Your Life, ch. 8",
     "book3-cornell-white", "mixture"},
    {"book3-cornell-aluminium", "A box of aluminium", "P. Shirley, The Rest of Your Life, ch. 10",
     "book3-cornell-aluminium", "mixture"},
    {"book3-cornell-glass-sphere-only", "A glass sphere, which half of the directions aim at",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass-guided", "guides"},
    {"book3-cornell-glass-guided", "A glass sphere, which the mixture aims at beside the light",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass-guided", "mixture"},
    {"book3-cornell-glass-mis", "The same by paths from the camera that connect to the light and meet it",
     "P. Shirley, The Rest of Your Life, ch. 10", "book3-cornell-glass", "mis"},
    {"book3-cornell-glass", "The same by what carlo does: paths from the light as well",
     "P. Shirley, The Rest of Your Life, ch. 10"},
    {"book3-pixels-random", "64 random samples a pixel", "P. Shirley, The Rest of Your Life, its later edition",
     "book3-cornell-first", "bsdf", "independent", 0, 64},
    {"book3-pixels-stratified", "64 samples a pixel, one in each of 32 boxes, twice",
     "P. Shirley, The Rest of Your Life, its later edition", "book3-cornell-first", "bsdf", "stratified", 0, 64},

    // K. Beason's 99 lines, and the lecture that explains them
    {"smallpt", "Mirror and glass ball between walls that are spheres", "K. Beason, smallpt"},
    {"smallpt-naive", "The same by chance alone", "K. Beason, smallpt", "smallpt", "bsdf"},
    {"smallpt-nee", "The same by connections to the light alone", "K. Beason, smallpt", "smallpt", "nee"},

    // Scenes of lajolla's document, and one scene of our own for each of its figures
    {"cbox", "Cornell box with measured spectra", "Cornell Program of Computer Graphics, by way of Mitsuba", "cbox", "",
     "", 1},
    {"veach-mi", "Plates of four roughnesses, lights of five sizes", "E. Veach, by way of lajolla"},
    {"sphere-light", "A ball of light above a floor", ours},
    {"arcade", "A courtyard between arches", ours, "arcade", "", "", -1},
    {"materials", "Diffuse, rough plastic, rough glass", ours, "materials", "", "", -0.5},
    {"filter-box", "Squares to the horizon, box filter", ours},
    {"filter-tent", "Squares to the horizon, tent filter", ours},
    {"filter-gaussian", "Squares to the horizon, Gaussian filter", ours},
    {"textures", "Chequered floor of polished marble, tiled wall", ours},
    {"ground-glass", "Rough glass, smooth glass and gloss under the picture of a sky", ours, "ground-glass", "", "",
     -2},
    {"mesh-formats", "Torus and trefoil knot", ours},
    {"globe", "A map about a ball, tiles about a box, under an evening sky", ours},

    // Stages of real-time ray tracing courses, in a room of our own
    {"hard-shadows", "A room lit by two points and by the sun", ours},
    {"fast-lens", "The room through a lens of f/1.4, focused on the ball", ours},
    {"ambient-occlusion", "The room by what is near", ours},
    {"one-bounce", "The room under a sky, light reflected once; a film's tone curve", ours, "one-bounce", "", "", 1, 0,
     render::ToneCurve::filmic},
    {"leaves", "A plant whose leaves are masks, a lattice and a veil", ours},
    {"metals", "Metals, and paint that is glossy over diffuse", "C. Wyman, DXR tutorials"},
    {"tinted-glass", "Green glass, the thicker the darker", "M. McGuire, The Graphics Codex"},
    {"blinn-phong", "Blinn-Phong's highlights", "M. McGuire, The Graphics Codex"},
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
