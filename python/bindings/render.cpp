#include "arrays.h"
#include "interruptible.h"
#include "module.h"

#include <gallery/scenes.h>
#include <picture/difference.h>
#include <picture/picture.h>

#include <render/film/confidence_interval.h>
#include <render/io/image/image_io.h>
#include <render/io/mesh/mesh_scene.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/layers.h>
#include <render/render.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace bindings {

namespace {

using py::arg;
using Image = render::Image;
using Float = render::Float;

// A picture. Without a render only the image of the result is known.
struct Picture {
  render::RenderResult result;
  bool is_rendered = false;

  Image& image() { return result.image; }
  const Image& image() const { return result.image; }
};
Picture picture_of(Image image) {
  Picture p;
  p.image() = std::move(image);
  return p;
}

py::array_t<Float> pixel_array(const Image& image, const std::vector<render::Spectrum>& pixels) {
  py::array_t<Float> array({image.height, image.width, 3});
  Float* out = array.mutable_data();
  for (const render::Spectrum& pixel : pixels)
    for (int c = 0; c < 3; ++c) *out++ = pixel[c];
  return array;
}

std::vector<render::Spectrum> to_pixels(const py::handle& object, const char* what) {
  const Array array = to_array(object, what);
  mc::require(array.ndim() == 3 && array.shape(2) == 3 && array.size() > 0,
              "{}: an array of shape {}; the shape must be (height, width, 3)", what, shape_text(array));
  std::vector<render::Spectrum> pixels(static_cast<std::size_t>(array.size()) / 3);
  const double* in = array.data();
  for (render::Spectrum& pixel : pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<Float>(*in++);
  return pixels;
}

Picture make_picture(const ArrayLike& radiance, const py::object& variance, std::uint32_t estimates) {
  Image image;
  image.pixels = to_pixels(radiance, "Picture: radiance");
  const py::array shape = py::array::ensure(radiance);
  image.height = static_cast<int>(shape.shape(0));
  image.width = static_cast<int>(shape.shape(1));
  if (!variance.is_none()) {
    image.variance = to_pixels(variance, "Picture: variance");
    image.estimates = estimates;
    const py::array other = py::array::ensure(variance);
    mc::require(std::equal(shape.shape(), shape.shape() + shape.ndim(), other.shape(), other.shape() + other.ndim()),
                "Picture: radiance of shape {} and variance of shape {}; they must be the same", shape_text(shape),
                shape_text(other));
  }
  return picture_of(std::move(image));
}

// The image at a path, or of a picture.
Image to_image(const py::handle& object) {
  if (py::isinstance<Picture>(object)) return object.cast<const Picture&>().image();
  return render::read_image(py::reinterpret_borrow<PathLike>(object).text());
}
std::string name_of(const py::handle& object, const char* name) {
  return py::isinstance<Picture>(object) ? name : py::reinterpret_borrow<PathLike>(object).text();
}

struct Comparison {
  std::vector<carlo::Metric> metrics;
  std::optional<carlo::DifferenceTests> tests; ///< none without variances
  double alpha;

  std::optional<double> p() const { return tests ? std::optional(tests->family_p()) : std::nullopt; }
  bool agrees() const {
    mc::require(tests.has_value(), "compare: no verdict, because a picture has no variance; render with two samples or "
                                   "more in every pixel");
    return tests->family_p() >= alpha;
  }
};

Comparison compare(const py::object& a, const py::object& b, double alpha, double tolerance) {
  mc::require(alpha > 0 && alpha < 1, "compare: alpha {} must lie in (0, 1)", alpha);
  mc::require(tolerance >= 0, "compare: tolerance {} must be >= 0", tolerance);
  const Image first = to_image(a), second = to_image(b);
  const std::string name_a = name_of(a, "a"), name_b = name_of(b, "b");
  carlo::require_comparable(name_a, first, name_b, second);
  Comparison c{carlo::difference_metrics(first, second), {}, alpha};
  if (first.variance.empty() || second.variance.empty()) return c;
  carlo::require_variance(name_a, first);
  carlo::require_variance(name_b, second);
  c.tests = carlo::test_difference(first, second, tolerance);
  return c;
}

struct RenderSettings {
  render::RenderOptions options;
  std::optional<std::pair<int, int>> size;
  std::optional<int> spp, max_depth;
  std::optional<std::string> strategy, sampler;
  std::string dialect;
  render::Variables variables;
  bool layers = false;
};

render::SceneFile read_scene(const std::string& file, const RenderSettings& s) {
  if (!render::is_mesh_file(file)) return render::read_mitsuba(file, render::dialect_from(s.dialect), s.variables);
  mc::require(s.variables.empty(), "render: '{}' is a mesh alone, which has no variables", file);
  return render::read_mesh_scene(file);
}

// A word that is neither a file nor looks like one is a scene of the gallery.
const carlo::GalleryScene* named_scene(const std::string& word) {
  const bool is_file = word.find_first_of("./") != std::string::npos || std::filesystem::exists(word);
  return is_file ? nullptr : &carlo::gallery_scene(word);
}

// The file of a scene of the gallery: in the package if it contains the scenes, else where carlo finds them.
std::string gallery_file(const carlo::GalleryScene& scene) {
  const auto module = py::module_::import("libmc").attr("__file__").cast<std::string>();
  const std::string name(scene.file.empty() ? scene.name : scene.file);
  const std::filesystem::path own =
      std::filesystem::path(module).parent_path() / "share/carlo/scenes" / (name + ".xml");
  return std::filesystem::exists(own) ? own.string() : carlo::scene_file(scene);
}

render::RenderOptions options_of(const RenderSettings& s, const render::RenderDefaults& defaults,
                                 const carlo::GalleryScene* named) {
  render::RenderOptions o = s.options;
  if (named && !named->strategy.empty()) o.strategy = render::strategy_from(named->strategy);
  if (named && !named->sampler.empty()) o.sampler = render::sampler_from(named->sampler);
  if (s.strategy) o.strategy = render::strategy_from(*s.strategy);
  if (s.sampler) o.sampler = render::sampler_from(*s.sampler);
  const bool is_limited = o.seconds || o.target_error;
  mc::require(!s.spp || !is_limited, "render: spp and {} exclude each other", o.seconds ? "seconds" : "target_error");
  std::tie(o.width, o.height) = s.size.value_or(std::pair(defaults.width, defaults.height));
  o.spp = s.spp.value_or(named && named->spp > 0 ? named->spp : defaults.spp);
  o.max_depth = s.max_depth.value_or(defaults.max_depth);
  o.aov = defaults.aov;
  return o;
}

void warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

Picture render_scene(const std::string& scene, const RenderSettings& s, const py::object& progress) {
  const carlo::GalleryScene* named = named_scene(scene);
  const std::string file = named ? gallery_file(*named) : scene;
  const render::SceneFile read = read_scene(file, s);
  for (const std::string& text : read.warnings) warn(text);
  render::RenderOptions options = options_of(s, read.defaults, named);
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  if (!progress.is_none())
    options.progress = [&](const render::Progress& p) {
      const py::gil_scoped_acquire lock;
      progress(p.fraction, p.samples, p.seconds, p.error.value);
    };
  render::RenderResult result;
  const bool interrupted = run_interruptible([&] { result = render::render(read.scene, options); }, cancel);
  if (interrupted && result.missing_rows == result.image.height) {
    PyErr_SetString(PyExc_KeyboardInterrupt, "render: interrupted before a row was rendered");
    throw py::error_already_set();
  }
  const carlo::Provenance from{file, "libmc.render", options.seed};
  if (const std::string text = carlo::invalid_samples_text(result, from); !text.empty()) warn(file + ": " + text);
  carlo::add_metadata(result, from);
  if (s.layers)
    result.image.layers = render::layers(
        read.scene,
        {options.width, options.height, options.crop.value_or(render::Crop{0, 0, options.width, options.height})},
        read.origin, options.threads);
  return {std::move(result), true};
}

constexpr const char* render_doc = R"(Renders a scene. Returns a Picture.

scene : a Mitsuba XML file, a mesh, or a name of the gallery such as "cbox"
Options, None for those of the scene:
  size = None (width, height), crop = None (x, y, width, height)
  spp = None : samples per pixel; or else
  seconds = None, target_error = None : limits of the time [s] and of the relative error
  adaptive = True  : more samples where the error is larger, after the first 16 of every pixel
  strategy = None, sampler = None : as for carlo render
  splat = True     : samples count for all pixels under the filter
  tiles = None, branches = None : 2x2 pixels share paths, and number of branches of a path; None: as a pilot favours
  max_depth = None : edges of a path; -1: no limit
  seed = 0, threads = 0 (all). The same seed gives the same bits, for any number of threads.
  layers = False   : fill Picture.layers: normals, positions, depth, albedo
  dialect = "mitsuba" or "lajolla"; variables = {} : values of $names
  progress = None  : called with (fraction, samples, seconds, relative_error)
Ctrl-C ends the render and returns what is known, with partial = True.)";

template <class T> auto of_result(T render::RenderResult::*member) {
  return [member](const Picture& p) { return p.is_rendered ? py::cast(p.result.*member) : py::object(py::none()); };
}

void bind_picture(py::module_& m) {
  using Result = render::RenderResult;
  py::class_<Picture>(m, "Picture", "Image of linear sRGB radiance with the variance of every pixel.")
      .def(py::init(&make_picture), arg("radiance"), arg("variance") = py::none(), arg("estimates") = 2,
           "From arrays (height, width, 3). `estimates` is the number of independent estimates behind the variance.")
      .def_property_readonly(
          "radiance", [](const Picture& p) { return pixel_array(p.image(), p.image().pixels); },
          "Radiance [W/(m^2 sr)], (height, width, 3); row 0 is the top.")
      .def_property_readonly(
          "variance",
          [](const Picture& p) {
            return p.image().variance.empty() ? py::object(py::none())
                                              : py::object(pixel_array(p.image(), p.image().variance));
          },
          "Variance of each pixel's mean, (height, width, 3); None if it is unknown.")
      .def(
          "interval_half_width",
          [](const Picture& p, double confidence) {
            mc::require(!p.image().variance.empty(), "interval_half_width: the picture has no variance");
            const Image half = render::interval_half_widths(p.image(), confidence);
            return pixel_array(half, half.pixels);
          },
          arg("confidence") = 0.95, "Half the widths of the pixels' confidence intervals, (height, width, 3).")
      .def_property_readonly(
          "layers",
          [](const Picture& p) {
            py::dict layers;
            for (const auto& [name, values] : p.image().layers) {
              py::array_t<float> array({p.image().height, p.image().width});
              std::copy(values.begin(), values.end(), array.mutable_data());
              layers[name.c_str()] = array;
            }
            return layers;
          },
          "Further channels by name, (height, width): normal N.X, position P.X, depth Z, albedo.R, id.")
      .def_property_readonly(
          "metadata", [](const Picture& p) { return p.image().metadata; }, "Scene, seed, samples.")
      .def_property_readonly(
          "estimates", [](const Picture& p) { return p.image().estimates; },
          "Independent estimates per pixel behind the variance.")
      .def_property_readonly("spp", of_result(&Result::spp), "Mean samples per pixel of a render.")
      .def_property_readonly("samples", of_result(&Result::samples), "Samples of a render.")
      .def_property_readonly("rays", of_result(&Result::rays), "Rays of a render.")
      .def_property_readonly("seconds", of_result(&Result::seconds), "Wall time of a render [s].")
      .def_property_readonly("cpu_seconds", of_result(&Result::cpu_seconds), "CPU time of a render [s].")
      .def_property_readonly("relative_error", of_result(&Result::relative_error),
                             "Root mean square of the pixels' relative standard errors.")
      .def_property_readonly("worst_error", of_result(&Result::worst_error), "The same in the worst 16x16 block.")
      .def_property_readonly("outlier_dominated", of_result(&Result::outlier_dominated),
                             "Share of pixels with an unreliable error bar.")
      .def_property_readonly("partial", of_result(&Result::partial), "Whether the render ended before its goal.")
      .def_property_readonly("invalid", of_result(&Result::invalid), "Samples that were not finite; they are left out.")
      .def(
          "save",
          [](const Picture& p, const PathLike& path, double exposure, const std::string& tone) {
            render::write_image(path.text(), p.image(), {render::tone_curve_from(tone), exposure});
          },
          arg("path"), arg("exposure") = 0.0, arg("tone") = "clamp",
          "Writes .exr (with variance and layers), .pfm, or .png by `exposure` [stops] and `tone`: clamp, reinhard or "
          "filmic.")
      .def("__repr__", [](const Picture& p) {
        std::string text = fmt::format("<Picture: {}x{}", p.image().width, p.image().height);
        if (p.is_rendered)
          text +=
              fmt::format(", {:.4g} samples per pixel, relative error {}", p.result.spp, carlo::format_error(p.result));
        return text + (p.is_rendered && p.result.partial ? ", partial>" : ">");
      });
}

void bind_comparison(py::module_& m) {
  using Deviation = carlo::LargestDeviation;
  py::class_<Deviation>(m, "LargestDeviation", "The test with the smallest p-value.")
      .def_readonly("p", &Deviation::p, "p-value of this test alone.")
      .def_readonly("t", &Deviation::t, "Difference in standard errors.")
      .def_readonly("dof", &Deviation::dof, "Degrees of freedom.")
      .def_readonly("difference", &Deviation::difference, "a - b.")
      .def_readonly("error", &Deviation::error, "Standard error of the difference.")
      .def_readonly("x", &Deviation::x, "Column of the pixel, or of the block's first pixel.")
      .def_readonly("y", &Deviation::y, "Row of the pixel, or of the block's first pixel.")
      .def_property_readonly(
          "channel", [](const Deviation& d) { return carlo::channel_names[static_cast<std::size_t>(d.channel)]; },
          "red, green or blue.")
      .def("__repr__", [](const Deviation& d) {
        return fmt::format("<LargestDeviation at ({}, {}): {:.3g}, {:.2f} standard errors, p = {:.2g}>", d.x, d.y,
                           d.difference, d.t, d.p);
      });
  py::class_<Comparison>(m, "Comparison", "Whether two pictures agree. It is true if they do.")
      .def_property_readonly(
          "metrics",
          [](const Comparison& c) {
            py::dict d;
            for (const carlo::Metric& metric : c.metrics) d[py::str(std::string(metric.name))] = metric.value;
            return d;
          },
          "mse, rmse, mae, relmse, max and mean_ratio.")
      .def_property_readonly("p", &Comparison::p, "Family-wise p-value; None where a picture has no variance.")
      .def_readonly("alpha", &Comparison::alpha, "Probability of calling two correct pictures different.")
      .def_property_readonly("agrees", &Comparison::agrees, "Whether p >= alpha. Raises Error without variances.")
      .def("__bool__", &Comparison::agrees)
      .def_property_readonly(
          "pixel", [](const Comparison& c) { return c.tests ? std::optional(c.tests->pixel) : std::nullopt; },
          "Largest deviation of a pixel.")
      .def_property_readonly(
          "block", [](const Comparison& c) { return c.tests ? std::optional(c.tests->block) : std::nullopt; },
          "Largest deviation of a block of 16x16 pixels.")
      .def("__repr__", [](const Comparison& c) {
        if (!c.tests) return fmt::format("<Comparison: rmse {:.6g}, no verdict>", c.metrics[1].value);
        return fmt::format("<Comparison: {}, p = {:.3g}, rmse {:.6g}>", c.agrees() ? "agree" : "differ", *c.p(),
                           c.metrics[1].value);
      });
}

} // namespace

void bind_render(py::module_& m) {
  bind_picture(m);
  bind_comparison(m);
  using Crop = std::array<int, 4>;
  m.def(
      "render",
      [](const PathLike& scene, std::optional<std::pair<int, int>> size, std::optional<Crop> crop,
         std::optional<int> spp, std::optional<double> seconds, std::optional<double> target_error, bool adaptive,
         std::optional<std::string> strategy, std::optional<std::string> sampler, bool splat, std::optional<bool> tiles,
         std::optional<int> branches, std::optional<int> max_depth, std::uint64_t seed, int threads, bool layers,
         const std::string& dialect, const render::Variables& variables, const py::object& progress) {
        RenderSettings s{{}, size, spp, max_depth, std::move(strategy), std::move(sampler), dialect, variables, layers};
        if (crop) s.options.crop = render::Crop{(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
        s.options.seconds = seconds;
        s.options.target_error = target_error;
        s.options.adaptive = adaptive;
        s.options.splat = splat;
        s.options.tiles = tiles;
        s.options.branches = branches;
        s.options.seed = seed;
        s.options.threads = threads;
        return render_scene(scene.text(), s, progress);
      },
      arg("scene"), py::kw_only(), arg("size") = py::none(), arg("crop") = py::none(), arg("spp") = py::none(),
      arg("seconds") = py::none(), arg("target_error") = py::none(), arg("adaptive") = true,
      arg("strategy") = py::none(), arg("sampler") = py::none(), arg("splat") = true, arg("tiles") = py::none(),
      arg("branches") = py::none(), arg("max_depth") = py::none(), arg("seed") = 0, arg("threads") = 0,
      arg("layers") = false, arg("dialect") = "mitsuba", arg("variables") = py::dict(), arg("progress") = py::none(),
      render_doc);
  m.def(
      "read_image", [](const PathLike& path) { return picture_of(render::read_image(path.text())); }, arg("path"),
      "Reads .exr (with its variance), .hdr, .pfm, .png or .jpg as a Picture.");
  m.def("compare", &compare, arg("a"), arg("b"), arg("alpha") = 0.01, arg("tolerance") = 0.0,
        R"(Compares two pictures, or their files: error metrics, and t-tests where the variances are known.

alpha is the probability of calling two correct pictures different, over all tests together; tolerance a difference
relative to b that counts as agreement. Returns a Comparison.)");
}

} // namespace bindings
