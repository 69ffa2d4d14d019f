#include <gallery/scenes.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <array>
#include <filesystem>
#include <vector>

namespace carlo {

namespace {

constexpr std::string_view book1 = "P. Shirley, Ray Tracing in One Weekend",
                           book3 = "P. Shirley, The Rest of Your Life", ours = "ours";

constexpr auto scenes = std::to_array<GalleryScene>({
    {"book1-diffuse", "Diffuse spheres that reflect half of the light", book1},
    {"book1-metal", "Mirrors", book1},
    {"book1-fuzzy-metal", "Fuzzy metal", book1},
    {"book1-glass", "Glass", book1},
    {"book1-hollow-glass", "Hollow glass", book1},
    {"book3-cornell-first", "Cornell box, its light shines up too", book3},
    {"book3-cornell-white", "Cornell box, its light faces down", book3},
    {"book3-cornell-aluminium", "A box of aluminium", book3},
    {"book3-cornell-glass", "A glass sphere", book3},
    {"book3-cornell-glass-guided", "A glass sphere, aimed at beside the light", book3, "", "mixture"},
    {"smallpt", "Mirror and glass ball between walls that are spheres", "K. Beason, smallpt"},
    {"cbox", "Cornell box with measured spectra", "Cornell Program of Computer Graphics, by way of Mitsuba", "", "", "",
     1},
    {"veach-mi", "Plates of four roughnesses, lights of five sizes", "after E. Veach, by way of lajolla"},
    {"textures", "Chequered floor, tiled wall", ours},
    {"ground-glass", "Rough glass, smooth glass and gloss under the picture of a sky", ours},
    {"mesh-formats", "Torus and trefoil knot", ours},
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
