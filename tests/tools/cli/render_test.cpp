// carlo render, run on the command line.

#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace {

using support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string scenes = MC_SOURCE_DIR "/librender/scenes/";

struct RenderCommand : support::ScratchTest {
  // Expects one line on stderr, exit code 2, and no picture file.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const support::ProcessResult run = run_carlo("render " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_TRUE(run.output.starts_with("carlo: ")) << run.output;
    for (const std::string& word : words) EXPECT_THAT(run.output, HasSubstr(word)) << arguments;
    EXPECT_FALSE(std::filesystem::exists(path("out.pfm")));
  }
  std::string cbox() const { return scenes + "cbox.xml --size 8x8 -o " + path("out.pfm"); }
};

TEST_F(RenderCommand, BadInput_IsReportedInOneLine) {
  expect_refused("nowhere.xml -o " + path("out.pfm"), {"nowhere.xml", "no such file"});
  expect_refused(cbox() + " --spp 0", {"0 samples per pixel", "at least 1"});
  expect_refused(cbox() + " --spp -3", {"-3 samples per pixel", "at least 1"});
  expect_refused(cbox() + " --time -1", {"-1", "> 0"});
  expect_refused(cbox() + " --target-error 0", {"target error of 0"});
  expect_refused(cbox() + " --target-error 0.1 --error-of wurst", {"--error-of 'wurst'", "picture or worst"});
  expect_refused(cbox() + " --adaptive perhaps", {"--adaptive 'perhaps'", "on or off"});
  expect_refused(cbox() + " --splat maybe", {"--splat 'maybe'", "on or off"});
  expect_refused(cbox() + " --sampler sobl", {"'sobl'", "did you mean 'sobol'"});
  expect_refused(cbox() + " --strategy miss", {"'miss'", "did you mean 'mis'"});
  expect_refused(cbox() + " --max-depth 0", {"--max-depth 0"});
  expect_refused(cbox() + " --branches 0", {"--branches 0 must be 1 to 1024"});
  expect_refused(cbox() + " --branches 1025", {"--branches 1025 must be 1 to 1024"});
  expect_refused(cbox() + " --branches 2 --tiles on", {"--branches", "--tiles on"});
  expect_refused(cbox() + " --spp 1 --intervals " + path("w.pfm"), {"--intervals", "two or more"});
  expect_refused(cbox() + " --intervals " + path("./out.pfm"), {"--intervals", "out.pfm", "would both write"});
  expect_refused(scenes + "cbox.xml -o nowhere.exr --intervals ./nowhere.exr", {"--intervals", "would both write"});
  expect_refused(cbox() + " --threads -2", {"--threads -2"});
  expect_refused(cbox() + " --crop 1,2,3", {"--crop '1,2,3'", "X,Y,WIDTH,HEIGHT"});
  expect_refused(cbox() + " --crop 0,0,4294967297,1", {"--crop '0,0,4294967297,1'"});
  expect_refused(scenes + "cbox.xml --size 4294967304x8 -o " + path("out.pfm"), {"--size '4294967304x8'"});
  expect_refused(scenes + "cbox.xml --size 1e6x1e6 -o " + path("out.pfm"), {"render: 1000000x1000000 pixels need "});
  expect_refused(cbox() + " --crop 6,0,3,3", {"crop of 3x3 pixels at (6, 0)", "8x8"});
  expect_refused(cbox() + " --layers", {"--layers", "out.pfm", ".exr"});
  expect_refused(cbox() + " --tone filmc", {"'filmc'", "did you mean 'filmic'"});
  for (const char* stops : {"bright", "1e3", "nan", "1x"})
    expect_refused(cbox() + " --exposure " + stops, {"--exposure '" + std::string(stops) + "'", "or auto"});
  expect_refused(scenes + "cbox.xml --resume -o " + path("out.exr"),
                 {"--resume", "does not exist", "in the first run"});
  expect_refused(cbox() + " --resume", {"--resume", "out.pfm' is no .exr"});
  expect_refused(cbox() + " --tone filmic", {"--tone", "out.pfm", ".png"});
  expect_refused(cbox() + " --exposure 1", {"--exposure", "out.pfm", ".png"});
  expect_refused(cbox() + " --compare-strategies", {"--compare-strategies", "out.pfm", ".png"});
  expect_refused(cbox() + " --compare-strategies --resume", {"--resume and --compare-strategies exclude each other"});
  expect_refused(cbox() + " --compare-strategies --exposure auto", {"--exposure auto is for one picture"});
  expect_refused(scenes + "hard-shadows.xml --strategy bsdf -o " + path("out.pfm"),
                 {"the strategy bsdf", "point or directional light", "use nee or mis"});
  expect_refused(scenes + "cbox.xml -o=" + path("out.pfm"), {"'=", "out.pfm' begins with =; leave that out"});
  expect_refused("nothing.obj -o " + path("out.pfm"), {"nothing.obj"});
  expect_refused(write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n") + " -o " + path("out.pfm"),
                 {"line.obj", "none of its 1 triangles has an area"});
  expect_refused(scenes + "cbox.xml --size 8 -o " + path("out.pfm"), {"--size '8'", "WIDTHxHEIGHT"});
  expect_refused(scenes + "cbox.xml -o " + path("no/such/out.pfm"), {"no/such", "does not exist"});
  expect_refused(scenes + "cbox.xml -o " + path("out.gif"), {".gif", ".exr, .pfm or .png"});
}

// A folder has the name of the output file. This also fails for root, who may ignore permissions.
TEST_F(RenderCommand, UnwritableOutput_IsReportedInOneLine) {
  std::filesystem::create_directory(path("taken.pfm"));
  const support::ProcessResult run =
      run_carlo("render " + scenes + "cbox.xml --spp 1 --size 4x4 -o " + path("taken.pfm"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("taken.pfm"));
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
}

TEST_F(RenderCommand, WritesLayers) {
  const support::ProcessResult run =
      run_carlo("render " + scenes + "sphere-light.xml --size 16x12 --spp 2 --layers -o " + path("l.exr"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto layers = render::read_image(path("l.exr")).layers;
  EXPECT_EQ(layers.size(), 11u);
  const std::size_t low = 11 * 16 + 8; // the floor
  EXPECT_NEAR(layers.at("N.Y")[low], 1, 1e-6);
  EXPECT_NEAR(layers.at("P.Y")[low], 0, 1e-5);
  EXPECT_NEAR(layers.at("albedo.G")[low], 0.5, 1e-6);
  EXPECT_EQ(layers.at("id")[low], 1);
  EXPECT_EQ(layers.at("id")[0], 0) << "the corner sees beyond the floor";
  EXPECT_EQ(layers.at("Z")[0], HUGE_VALF);
}

// The PNG has the tone-mapped radiance; with automatic exposure the picture's mean becomes middle grey.
TEST_F(RenderCommand, AppliesToneToPng) {
  const std::string start = "render " + scenes + "sphere-light.xml --size 8x8 --spp 4 -o ";
  for (const char* tone : {"", " --tone reinhard", " --tone filmic --exposure auto", " --exposure auto"}) {
    ASSERT_EQ(run_carlo(start + path("a.png") + tone).exit_code, 0) << tone;
    ASSERT_EQ(run_carlo(start + path("a.pfm")).exit_code, 0);
    const render::Image shown = render::read_image(path("a.png")), radiance = render::read_image(path("a.pfm"));
    const std::string words = tone;
    render::ToneMapping by;
    if (words.find("reinhard") != std::string::npos) by.curve = render::ToneCurve::reinhard;
    if (words.find("filmic") != std::string::npos) by.curve = render::ToneCurve::filmic;
    if (words.find("auto") != std::string::npos) by.exposure = auto_exposure(radiance);
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown.pixels[i][c], tone_map(radiance.pixels[i], by)[c], 0.01) << tone << " " << i;
  }
}

// Two runs of 8 samples give a picture of 16: the samples differ, and the variance covers all of them.
TEST_F(RenderCommand, Resume_AddsSamples) {
  const std::string line = "render " + scenes + "sphere-light.xml --size 16x12 --spp 8 -o " + path("r.exr");
  ASSERT_EQ(run_carlo(line + " --layers").exit_code, 0);
  const render::Image first = render::read_image(path("r.exr"));
  const support::ProcessResult run = run_carlo(line + " --resume");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("16 samples per pixel of 2 runs"));
  const render::Image second = render::read_image(path("r.exr"));
  EXPECT_EQ(second.metadata.at("carlo.samples_per_pixel"), "16");
  EXPECT_EQ(second.metadata.at("carlo.runs"), "2");
  EXPECT_EQ(second.layers, first.layers);
  int changed = 0;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    changed += (first.pixels[i] != second.pixels[i]).any();
    before += double(first.variance[i].sum());
    after += double(second.variance[i].sum());
  }
  EXPECT_GT(changed, 100);
  EXPECT_LT(after, 0.8 * before);
  const support::ProcessResult third = run_carlo(line + " --resume");
  EXPECT_THAT(third.output, HasSubstr("24 samples per pixel of 3 runs"));
  const auto refused = [&](const std::string& arguments, const char* word) {
    const support::ProcessResult wrong = run_carlo("render " + arguments);
    EXPECT_EQ(wrong.exit_code, 2) << wrong.output;
    EXPECT_THAT(wrong.output, HasSubstr(word));
  };
  const std::string png = "render " + scenes + "sphere-light.xml --size 16x12 --spp 8 -o " + path("r.PNG");
  ASSERT_EQ(run_carlo(png + " --tone filmic").exit_code, 0) << "large letters are the same extension";
  refused(png.substr(7) + " --resume", "r.PNG' is no .exr: other formats do not store radiance");
  refused(scenes + "cbox.xml --size 16x12 --spp 8 --resume -o " + path("r.exr"), "a picture of 'sphere-light.xml'");
  refused(scenes + "sphere-light.xml --size 8x8 --spp 8 --resume -o " + path("r.exr"), "has 16x12 pixels");
}

// One sample per pixel gives no variance, so the sum has none either, and the output states it.
TEST_F(RenderCommand, Resume_FromOneSampleHasNoErrorBar) {
  const std::string line = "render " + scenes + "sphere-light.xml --size 8x8 -o " + path("r.EXR");
  ASSERT_EQ(run_carlo(line + " --spp 1").exit_code, 0);
  EXPECT_THAT(run_carlo(line + " --spp 8 --resume").output,
              HasSubstr("9 samples per pixel of 2 runs; no error bar, as one run took one sample"));
  EXPECT_TRUE(render::read_image(path("r.EXR")).variance.empty());
}

TEST_F(RenderCommand, Resume_KeepsLayersAndVariance) {
  const std::string line = "render " + scenes + "sphere-light.xml --size 8x8 -o " + path("r.exr");
  ASSERT_EQ(run_carlo(line + " --spp 4").exit_code, 0);
  const std::string before = mc::read_file(path("r.exr"));
  EXPECT_THAT(run_carlo(line + " --spp 1 --resume").output, HasSubstr("would lose its own; take --spp 2 or more"));
  EXPECT_EQ(mc::read_file(path("r.exr")), before);
  render::Image early = render::read_image(path("r.exr"));
  early.metadata["carlo.unsampled"] = "some pixels";
  render::write_image(path("r.exr"), early);
  EXPECT_THAT(run_carlo(line + " --spp 4 --resume").output,
              HasSubstr("has pixels without a sample, as its run was interrupted early; render it again"));
}

TEST_F(RenderCommand, SceneFiles_AreNotOverwritten) {
  render::Image sky(2, 1);
  for (render::Spectrum& p : sky.pixels) p = render::Spectrum::Ones();
  render::write_image(path("sky.exr"), sky);
  const std::string scene =
      write("s.xml", "<scene version=\"0.6.0\"><emitter type=\"envmap\"><string name=\"filename\" "
                     "value=\"sky.exr\"/></emitter><sensor type=\"perspective\"/></scene>");
  const std::string before = mc::read_file(path("sky.exr"));
  for (const std::string& arguments :
       {" -o " + path("sky.exr"), " -o " + path("a.exr") + " --intervals " + path("./sky.exr")})
    EXPECT_THAT(run_carlo(fmt::format("render {} --size 4x4 --spp 2{}", scene, arguments)).output,
                HasSubstr("sky.exr' over a file of the scene; name another file"));
  EXPECT_EQ(mc::read_file(path("sky.exr")), before);
}

// Pictures of different scenes are not averaged.
TEST_F(RenderCommand, Resume_RejectsAnotherPicture) {
  std::string text = mc::read_file(scenes + "sphere-light.xml");
  const auto put = [&](const std::string& old, const std::string& now) {
    text.replace(text.find(old), old.size(), now);
  };
  put("direct", "path");
  put("<integrator", "<default name=\"n\" value=\"8\"/><integrator");
  put("value=\"8\"/>\n\t\t</emitter>", "value=\"$n\"/>\n\t\t</emitter>");
  const std::string line = "render " + write("s.xml", text) + " --spp 2 -o " + path("r.exr"),
                    same = " --crop 2,2,8,8 --size 16x12 --resume";
  ASSERT_EQ(run_carlo(line + " --crop 2,2,8,8 --size 16x12").exit_code, 0);
  const support::ProcessResult other = run_carlo(line + same + " --sampler independent --strategy nee --seed 3");
  EXPECT_EQ(other.exit_code, 0) << other.output;
  EXPECT_THAT(other.output, HasSubstr("r.exr' was rendered with --sampler 'sobol', not 'independent'; both are"));
  EXPECT_THAT(other.output, HasSubstr("r.exr' was rendered with --seed '0', not '3'; both are averaged"));
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const support::ProcessResult run = run_carlo(line + arguments);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr(path("r.exr") + "' " + words));
  };
  refused(" --crop 2,2,8,8 --size 20x12 --resume", "was rendered with --size '16x12', not '20x12'");
  refused(" --crop 3,2,8,8 --size 16x12 --resume", "was rendered with --crop '2,2,8,8', not '3,2,8,8'");
  refused(same + " --max-depth 3", "was rendered with --max-depth '-1', not '3'");
  refused(same + " --dialect lajolla", "was rendered with --dialect 'mitsuba', not 'lajolla'");
  refused(same + " -D n=9", "was rendered with -D '', not 'n=9'");
  refused(same + " --strategy light",
          "was rendered with a --strategy that finds 'all light', not 'light towards lamps alone'");
  write("s.xml", text + "<!-- other -->");
  refused(same, "was rendered with files of a scene whose bytes have the hash '");
  render::Image older = render::read_image(path("r.exr"));
  for (const std::string spp : {"inf", "1e99", "nan", "-2", "2x"}) {
    older.metadata["carlo.samples_per_pixel"] = spp;
    render::write_image(path("r.exr"), older);
    refused(same, "says '" + spp + "' samples per pixel; a number in (0, 1e+15] is needed");
  }
  older.metadata["carlo.samples_per_pixel"] = "2";
  older.metadata["carlo.runs"] = "1e99";
  render::write_image(path("r.exr"), older);
  refused(same, "says '1e99' runs");
  older.metadata["carlo.runs"] = "1";
  older.metadata.erase("carlo.max_depth");
  render::write_image(path("r.exr"), older);
  refused(same, "does not state its carlo.max_depth");
}

TEST_F(RenderCommand, Resume_RejectsChangedFiles) {
  write("sky.xml", "<scene version=\"0.6.0\"><emitter type=\"constant\"/></scene>");
  const std::string scene = write("s.xml", "<scene version=\"0.6.0\"><include filename=\"sky.xml\"/><sensor "
                                           "type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor></scene>");
  const std::string line = "render " + scene + " --size 4x4 --spp 2 -o " + path("r.exr");
  ASSERT_EQ(run_carlo(line).exit_code, 0);
  EXPECT_EQ(run_carlo(line + " --resume").exit_code, 0);
  write("sky.xml", "<scene version=\"0.6.0\"><emitter type=\"constant\"><rgb name=\"radiance\" value=\"3\"/></emitter>"
                   "</scene>");
  const support::ProcessResult run = run_carlo(line + " --resume");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("whose bytes have the hash '"));
}

TEST_F(RenderCommand, ComparesStrategies) {
  const support::ProcessResult run = run_carlo("render " + scenes +
                                               "sphere-light.xml --size 4x3 --spp 4 "
                                               "--compare-strategies -o " +
                                               path("s.png"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("same samples"));
  EXPECT_THAT(run.output, HasSubstr("1, 4, 16, 64, 256, 1024 samples per pixel"));
  EXPECT_EQ(render::read_image(path("s.png")).width, 4 + 104 + 6 * 84) << "a column of names, six of pictures";
}

TEST_F(RenderCommand, WritesIntervals) {
  const support::ProcessResult run = run_carlo("render " + cbox() + " --spp 8 --intervals " + path("w.pfm"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const render::Image image = render::read_image(path("out.pfm")), widths = render::read_image(path("w.pfm"));
  ASSERT_EQ(widths.pixels.size(), image.pixels.size());
  double sum = 0;
  for (const render::Spectrum& w : widths.pixels) {
    EXPECT_TRUE((w >= 0).all());
    sum += double(w.sum());
  }
  EXPECT_GT(sum, 0);
}

// A mesh needs no scene file; a crop equals the same part of the whole picture.
TEST_F(RenderCommand, AcceptsAMeshAndACrop) {
  const std::string mesh = scenes + "meshes/torus.ply --size 24x16 --spp 8 -o ";
  ASSERT_EQ(run_carlo("render " + mesh + path("whole.exr")).exit_code, 0);
  const support::ProcessResult run = run_carlo("render " + mesh + path("part.exr") + " --crop 5,2,9,10");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("9x10"));
  const render::Image whole = render::read_image(path("whole.exr")), part = render::read_image(path("part.exr"));
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 9; ++x) EXPECT_TRUE((part.at(x, y) == whole.at(x + 5, y + 2)).all()) << x << " " << y;
  EXPECT_GT(whole.at(12, 8).sum(), 0);
}

// Float cannot resolve a pebble in a scene a thousand kilometres wide.
TEST_F(RenderCommand, SceneTooLargeForFloat_IsWarnedAbout) {
  const std::string start = R"(<scene version="0.5.0"><sensor type="perspective"><float name="fov" value="40"/></sensor>
    <emitter type="constant"/><shape type="sphere"><point name="center" x="0" y="0" z="5"/></shape>
    <shape type="sphere"><point name="center")";
  const auto render_with = [&](const std::string& place) {
    return run_carlo("render " + write("pebble.xml", start + place + "</shape></scene>") + " --spp 2 --size 4x4 -o " +
                     path("out.pfm"));
  };
  const support::ProcessResult coarse = render_with(R"( x="1e6" y="0" z="0"/><float name="radius" value="0.01"/>)");
  EXPECT_EQ(coarse.exit_code, 0) << coarse.output;
  EXPECT_THAT(coarse.output, HasSubstr("carlo: warning: " + path("pebble.xml") + ": a surface 0.0346 across"));
  const support::ProcessResult fine = render_with(R"( x="1e6" y="0" z="0"/><float name="radius" value="1000"/>)");
  EXPECT_THAT(fine.output, Not(HasSubstr("warning")));
  const support::ProcessResult huge = render_with(R"( x="0" y="0" z="0"/><float name="radius" value="1e20"/>)");
  EXPECT_THAT(huge.output,
              HasSubstr("pebble.xml: the scene is 3.46e+20 across; areas and squared distances in floats"));
}

TEST_F(RenderCommand, SceneWithoutLightIsBlackWithAWarning) {
  const std::string scene = write("dark.xml", R"(<scene version="0.5.0">
    <sensor type="perspective"><float name="fov" value="40"/></sensor>
    <shape type="sphere"><point name="center" x="0" y="0" z="5"/></shape></scene>)");
  const support::ProcessResult run = run_carlo("render " + scene + " --spp 2 --size 4x4 -o " + path("out.pfm"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("warning"), HasSubstr("no light")));
  for (const auto& p : render::read_image(path("out.pfm")).pixels) EXPECT_TRUE((p == 0).all());
}

// A plate under a slab of glass, lit by a sun from straight above: no path from the camera finds the sun.
TEST_F(RenderCommand, SunThroughGlass_IsMissedWithAWarning) {
  const std::string scene = write("slab.xml", R"(<scene version="0.5.0">
    <sensor type="perspective"><float name="fov" value="20"/><transform name="toWorld">
      <lookat origin="0,6,6" target="0,0,0" up="0,1,0"/></transform></sensor>
    <emitter type="directional" id="sun"><vector name="direction" x="0" y="-1" z="0"/></emitter>
    <shape type="rectangle"><transform name="toWorld"><rotate x="1" angle="-90"/></transform></shape>
    <shape type="rectangle" id="slab"><bsdf type="dielectric"/><transform name="toWorld"><rotate x="1" angle="-90"/>
      <scale value="4"/><translate y="1"/></transform></shape></scene>)");
  const auto warned = [&](const std::string& options) {
    return run_carlo("render " + scene + " --spp 2 --size 4x4 -o " + path("out.exr") + options).output;
  };
  const std::string words = "light of the directional 'sun' (" + scene +
                            ":4) by way of smooth surfaces, such as the "
                            "rectangle 'slab' (" +
                            scene + ":6), is missing";
  for (const char* name : {"nee", "mis"}) EXPECT_THAT(warned(std::string(" --strategy ") + name), HasSubstr(words));
  EXPECT_THAT(warned(" --strategy mis"), HasSubstr("; mis cannot find it: use mis+lt"));
  EXPECT_THAT(render::read_image(path("out.exr")).metadata.at("carlo.missing_light"), HasSubstr(words));
  EXPECT_THAT(warned(""), HasSubstr(words + " where it is seen in a mirror or through glass"));
  EXPECT_THAT(warned(" --strategy mis --max-depth 2"), Not(HasSubstr("missing")));
  // A faint sky, since pictures without light have no error.
  std::string lit = mc::read_file(scene);
  lit.insert(lit.find("</scene>"), R"(<emitter type="constant"><rgb name="radiance" value="0.1"/></emitter>)");
  write("slab.xml", lit);
  for (const std::string command : {"converge", "trade"}) {
    const auto run =
        run_carlo(command + " " + scene + " --strategies mis+lt --size 4x4 --max-spp 32 -o " + path("measured"));
    EXPECT_THAT(run.output, AllOf(HasSubstr(words), HasSubstr("it is missing in the reference, too")));
    EXPECT_THAT(mc::read_file(path(command == "trade" ? "measured/trade.json" : "measured/slab.json")),
                HasSubstr("\"missing_light\": \"light of the directional 'sun'"));
  }
  // Through a filter this wide, light paths do not pay.
  std::string wide = mc::read_file(scene);
  wide.replace(wide.find("</sensor>"), 0, R"(<film type="hdrfilm"><rfilter type="box"><float name="radius" value="99"/>
    </rfilter></film>)");
  write("slab.xml", wide);
  for (const char* name : {"mis", "mis+lt"})
    EXPECT_THAT(warned(std::string(" --strategy ") + name),
                HasSubstr(fmt::format("is missing; {} cannot find it: use a small lamp in place of the light", name)));
}

TEST_F(RenderCommand, StrategyThatMissesLight_IsWarnedAbout) {
  const std::string words = "warning: the strategy light takes directions toward lights";
  EXPECT_THAT(run_carlo("render " + cbox() + " --spp 1 --strategy light").output, HasSubstr(words));
  for (const char* fine : {" --strategy mis", " --strategy mixture", " --strategy light --max-depth 2"})
    EXPECT_THAT(run_carlo("render " + cbox() + " --spp 1" + fine).output, Not(HasSubstr("warning"))) << fine;
}

TEST_F(RenderCommand, ResultsDoNotDependOnThreadsAndHaveMetadata) {
  for (const char* threads : {"1", "2"}) {
    const support::ProcessResult run =
        run_carlo("render " + scenes + "cbox.xml --spp 4 --size 24x16 --seed 5 --threads " + threads + " -o " +
                  path(threads) + ".exr");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, AllOf(HasSubstr("samples/s"), HasSubstr("rays/s"),
                                  HasSubstr("mean relative standard error"), HasSubstr(" 0 invalid samples")));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 3)
        << "no progress bar without a terminal: " << run.output;
    EXPECT_THAT(run.output, testing::Not(testing::ContainsRegex("\n[^\n]{81}"))) << "short lines";
  }
  const render::Image a = render::read_image(path("1.exr")), b = render::read_image(path("2.exr"));
  ASSERT_EQ(a.pixels.size(), 24u * 16u);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    EXPECT_TRUE((a.pixels[i] == b.pixels[i]).all());
    EXPECT_TRUE((a.variance[i] == b.variance[i]).all());
  }
  EXPECT_EQ(a.metadata.at("carlo.seed"), "5");
  EXPECT_EQ(a.metadata.at("carlo.samples_per_pixel"), "4");
  EXPECT_THAT(a.metadata.at("carlo.command"), HasSubstr("--seed 5"));
  EXPECT_NE(a.metadata.at("carlo.commit"), "");
  EXPECT_FALSE(a.metadata.contains("carlo.partial"));
}

} // namespace
