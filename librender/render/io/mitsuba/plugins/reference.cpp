#include <render/io/mitsuba/plugins.h>
#include <render/io/mitsuba/plugins/reference.h>

namespace render::mitsuba {

namespace {

constexpr const char* introduction = R"(# Scene files

`carlo render` reads Mitsuba XML, versions 0.4 to 0.6. `carlo render --help-scene` prints this text. An element or
parameter that is not listed is refused with its file and line. Entries marked (ours) are not in Mitsuba. Names of
Mitsuba 2 and 3 are accepted: `to_world`, `int_ior`.

- **Parameters** are written `<float name="fov" value="40"/>`: number `<float>` or `<integer>`, integer `<integer>`,
  boolean `<boolean>`, file and words `<string>`, point `<point>` or `<vector>` with x, y, z or a value.
- **Colours** are `<rgb>` (linear sRGB) or `<srgb>` (by the sRGB curve) with three numbers, one for all, or `#rrggbb`;
  or `<spectrum>` with one number or `wavelength:value` pairs [nm]; or `<float>`, a grey. The illuminant of reflectance
  spectra has equal energy, as in Mitsuba 0.6, so white is warm. It is daylight in scenes of version 2 and later, as in
  Mitsuba 3. Beyond the pairs a spectrum falls to 0 within their mean distance, and from version 2 on at once. With
  `--dialect lajolla` it stays constant.
- **Transforms** are `<transform>` with `<translate>`, `<scale>`, `<rotate>` (angle in degrees), `<lookAt>` and
  `<matrix>` (16 numbers, row by row), applied in the order in which they stand.
- **Variables**: `<default name="spp" value="16"/>` and then `$spp` in any value below it; of two defaults with one name
  the first counts, and before both `carlo render -D spp=16`.
- **Files** are named relative to the scene file, or to a folder that `<path value="textures"/>` names above;
  `<include filename="base.xml"/>` inserts the content of another scene file.
- **Sides**: opaque BSDFs reflect on the side of the normal, and the other side is black, as in Mitsuba; inside
  `<bsdf type="twosided">` they reflect on both. `fuzzymetal` (ours) always does, and with `--dialect lajolla` all do.
- **References**: `<ref id="white"/>` stands for the bsdf, texture, emitter, medium, film, rfilter or sampler with this
  id, at any place of the file. `<ref name="reflectance" id="wood"/>` makes a texture a parameter.
- "-" as default: the parameter must be given. Where lajolla's default differs, `--dialect lajolla` takes that one.
)";

std::string row_of(const Declaration& d) {
  std::string fallback = d.fallback;
  if (!d.lajolla.empty() && d.lajolla != d.fallback) fallback += fmt::format(" (lajolla: {})", d.lajolla);
  std::string meaning = d.meaning;
  if (!d.has_effect) {
    fallback = "";
    meaning = "no effect: " + meaning;
  } else if (d.only) {
    meaning = fmt::format("only {} is supported: {}", *d.only, meaning);
  } else if (!d.mitsuba_alternative.empty()) {
    meaning += " (lajolla's alone)";
  }
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", d.name, d.type, d.unit, fallback, meaning);
}

std::string body_of(const PluginText& row) {
  std::string text = fmt::format(": {}\n", row.meaning);
  if (row.parameters.empty()) return text;
  text += "\n| parameter | type | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const Declaration& d : row.parameters) text += row_of(d);
  return text;
}

template <class T> std::vector<PluginText> texts(const Plugins<T>& rows) { return {rows.begin(), rows.end()}; }

} // namespace

std::vector<Kind> all_plugins() {
  return {
      {"integrator", "how paths are followed", texts(integrator_plugins())},
      {"sensor", "the camera", texts(sensor_plugins())},
      {"film", "inside a sensor", texts(film_plugins())},
      {"rfilter", "inside a film", texts(filter_plugins())},
      {"sampler", "inside a sensor", texts(sampler_plugins())},
      {"bsdf", "the material of a shape; of the scene with an id, or inside a shape", texts(bsdf_plugins())},
      {"texture", "a colour that varies; of the scene with an id, or a parameter", texts(texture_plugins())},
      {"shape", "the geometry", texts(shape_plugins())},
      {"medium",
       "inside a shape: its interior, or named exterior what is around it; inside a sensor: what is around the camera. "
       "If one shape lies in another, both name the medium between them",
       texts(medium_plugins())},
      {"phase", "inside a medium", texts(phase_plugins())},
      {"emitter in a shape", "the light of its surface", texts(surface_emitter_plugins())},
      {"emitter", "of the scene: lights that are no shapes", texts(emitter_plugins())},
  };
}

std::string reference() {
  std::string text = introduction;
  for (const Kind& kind : all_plugins()) {
    text += fmt::format("\n## {}\n\nThe {}: {}.\n", kind.tag, kind.tag, kind.meaning);
    std::string names;
    for (std::size_t i = 0; i < kind.rows.size(); ++i) { // adjacent plugins with equal tables share one table
      names += fmt::format("{}**{}**", names.empty() ? "\n" : ", ", kind.rows[i].name);
      const std::string body = body_of(kind.rows[i]);
      if (i + 1 < kind.rows.size() && body_of(kind.rows[i + 1]) == body) continue;
      text += names + body;
      names.clear();
    }
  }
  return text;
}

} // namespace render::mitsuba
