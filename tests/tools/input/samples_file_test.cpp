// carlo validate --samples-file --pdf-file: densities on grids, smooth and stepped, right and wrong, and bad files.

#include "tools/input/samples_scratch.h"

#include <render/io/image/image_io.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::refusal, support::run;
using testing::AllOf, testing::ContainsRegex, testing::HasSubstr;

using std::numbers::pi;

double ramp_mean(int i, int) { return (2.0 * i + 1) / 16; }
double one(int, int) { return 1; }

// The mean of a cosine lobe about +z over a cell of a latitude-longitude grid of height 32.
double cosine_mean(int, int j) {
  const double a = std::cos(pi * j / 32), b = std::cos(pi * (j + 1) / 32);
  return j < 16 ? (a * a - b * b) / (2 * pi * (a - b)) : 0;
}

TEST_F(SamplesFile, DensityVaryingWithinCells_Passes) {
  // 16 columns for 40000 samples of a linear density: bins finer than a cell would reject it.
  const Output out = run(options(samples(ramp), grid(16, 1, ramp_mean)));
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, AllOf(HasSubstr("1 of 1 cases passed"), HasSubstr("35556 samples each")));
}

TEST_F(SamplesFile, EverySeed_ShufflesRowsAndPasses) {
  ValidateCommandOptions o = options(samples(ramp), grid(16, 4, ramp_mean));
  int passed = 0;
  for (o.seed = 1; o.seed <= 20; ++o.seed) passed += run(o).code == carlo::exit_ok;
  // All seeds use the same samples, so they are not independent; at alpha = 0.01 two failures in twenty are unlikely.
  EXPECT_GE(passed, 19);
}

TEST_F(SamplesFile, WrongDensity_IsRejectedWithPlace) {
  const Output out = run(options(samples(ramp), grid(16, 16, [](int, int j) { return ramp_mean(j, 0); })));
  EXPECT_EQ(out.code, carlo::exit_failed);
  EXPECT_THAT(out.text, AllOf(HasSubstr("likely cause: "), HasSubstr(" about (0."),
                              ContainsRegex("cell .*y [0-9.]+ to [0-9.]+.* contains [0-9]+ samples"),
                              HasSubstr("again: carlo validate --samples-file '")));
}

TEST_F(SamplesFile, SwappedNeighbourCells_AreRejected) {
  const auto checked = [](mc::Pcg& random) { // 200 columns; every other one is empty
    const double cell = std::floor(100 * random.uniform<double>());
    return fmt::format("{:.7f}", (2 * cell + random.uniform<double>()) / 200);
  };
  const std::string file = samples(checked);
  const auto grid_of = [&](double even, double odd) {
    return grid(200, 1, [=](int i, int) { return i % 2 == 0 ? even : odd; });
  };
  EXPECT_EQ(run(options(file, grid_of(2, 0))).code, carlo::exit_ok);
  EXPECT_EQ(run(options(file, grid_of(0.1, 1.9))).code, carlo::exit_failed);
}

TEST_F(SamplesFile, ThreePercentSlopeError_IsRejected) {
  // Density 2 x against 0.03 + 1.97 x: the cell means differ by at most 1.5 % where most samples are, and by 48 % in
  // the first of 16 columns.
  EXPECT_EQ(run(options(samples(ramp), grid(16, 1, [](int i, int) { return 0.03 + 0.97 * ramp_mean(i, 0); }))).code,
            carlo::exit_failed);
}

TEST_F(SamplesFile, Integral_MustBeOneUnlessUnnormalized) {
  ValidateCommandOptions o = options(samples(ramp), grid(16, 1, [](int i, int) { return 1.01 * ramp_mean(i, 0); }));
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_failed);
  EXPECT_THAT(out.text,
              AllOf(HasSubstr("likely cause: mass"), ContainsRegex("the density integrates to 1.0(099|100)")));
  o.unnormalized = true;
  EXPECT_EQ(run(o).code, carlo::exit_ok);
}

TEST_F(SamplesFile, SampleAtZeroDensity_NamesItsLine) {
  const std::string file = samples(ramp);
  std::ofstream(file, std::ios::app) << "0.01, 0.5\n";
  ValidateCommandOptions o = options(file, grid(64, 1, [](int i, int) { return i == 0 ? 0.0 : (2.0 * i + 1) / 64; }));
  o.unnormalized = true;
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_failed);
  EXPECT_THAT(out.text,
              AllOf(HasSubstr("likely cause: leak"), HasSubstr("s.csv:"), HasSubstr("in cell (0, 0) of the grid")));
}

TEST_F(SamplesFile, SampleRoundedOverEdge_IsAccepted) {
  const auto draw = [](mc::Pcg& random) {
    return fmt::format("{}", std::max(0.5 - 4e-7, 0.5 + 0.5 * random.uniform<double>() - 1e-4));
  };
  EXPECT_EQ(run(options(samples(draw), grid(2, 1, [](int i, int) { return 2.0 * i; }))).code, carlo::exit_ok);
}

// The density is infinite at 1, and a double rounds the last 6e-4 of the mass to 1. This is no fault of the sampler.
TEST_F(SamplesFile, SampleAtInfiniteDensityEdge_IsMeasureZero) {
  ValidateCommandOptions o;
  o.samples_file = samples([](mc::Pcg& r) { return fmt::format("{:.17g}", 1 - std::pow(r.uniform<double>(), 5)); });
  o.pdf = "0.2*(1-x)^-0.8";
  const auto fails = [](const auto& text) { return testing::FieldsAre(carlo::exit_failed, text); };
  EXPECT_THAT(run(o), testing::FieldsAre(carlo::exit_ok,
                                         AllOf(HasSubstr("pass (boundary of measure zero)"), HasSubstr("pdf = inf"))));
  o.open_interval = true;
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  o.pdf = "0.21*(1-x)^-0.79";
  EXPECT_THAT(run(o), fails(AllOf(HasSubstr("likely cause: shape"), HasSubstr(" --open-interval"))));
}

TEST_F(SamplesFile, IntervalWithBounds_Passes) {
  const auto draw = [](mc::Pcg& random) { return fmt::format("{}", 4 * std::sqrt(random.uniform<double>()) - 1); };
  ValidateCommandOptions o = options(samples(draw), grid(16, 1, [](int i, int) { return ramp_mean(i, 0) / 4; }));
  o.domain = "x=-1:3";
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  o.domain = "x=-1:3.1";
  EXPECT_EQ(run(o).code, carlo::exit_failed);
}

TEST_F(SamplesFile, LatitudeLongitudeGrid_Passes) {
  const std::string file = samples(cosine);
  EXPECT_EQ(run(options(file, grid(8, 32, cosine_mean))).code, carlo::exit_ok);
  // The uniform hemisphere, which also has mass 1.
  EXPECT_EQ(run(options(file, grid(8, 32, [](int, int j) { return j < 16 ? 1 / (2 * pi) : 0; }))).code,
            carlo::exit_failed);
  const auto turned = [](mc::Pcg& random) { // rotated by a right angle about x
    double x, y, z;
    std::sscanf(cosine(random).c_str(), "%lf %lf %lf", &x, &y, &z);
    return fmt::format("{} {} {}", x, z, -y);
  };
  EXPECT_EQ(run(options(samples(turned), grid(8, 32, cosine_mean))).code, carlo::exit_failed);
  const auto lower = [](mc::Pcg& random) { // in the upper hemisphere, but too low
    const double z = std::cbrt(random.uniform<double>()), phi = 2 * pi * random.uniform<double>();
    return fmt::format("{} {} {}", std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
  };
  ValidateCommandOptions o = options(samples(lower), grid(8, 32, cosine_mean));
  o.verbose = true;
  EXPECT_THAT(run(o).text, HasSubstr(" theta [deg] in ["));
}

TEST_F(SamplesFile, GreyExr_IsGrid) {
  render::Image image(16, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 16; ++x) image.at(x, y).setConstant(static_cast<render::Float>(ramp_mean(x, y)));
  ValidateCommandOptions o = options(samples(ramp), path("p.exr"));
  render::write_image(o.pdf_file, image);
  EXPECT_EQ(run(o).code, carlo::exit_ok);
  image.at(3, 2)[1] += 1;
  render::write_image(o.pdf_file, image);
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("p.exr: pixel (3, 2) is ("), HasSubstr("a density is grey")));
  image.at(3, 2).setConstant(-1);
  render::write_image(o.pdf_file, image);
  EXPECT_THAT(refusal(o), HasSubstr("a density is finite and >= 0"));
  o.pdf_file = write("torn.exr", "v/1");
  EXPECT_THAT(refusal(o), HasSubstr("torn.exr"));
}

TEST_F(SamplesFile, Breaks_AreAccepted) {
  const auto steps = [](mc::Pcg& r) { // density 0.4, 1.6, 0.4, 1.6, ... on 64 bins
    const double u = 32 * r.uniform<double>(), bin = std::floor(u), x = u - bin;
    return fmt::format("{:.9f}", (2 * bin + (x < 0.2 ? x / 0.2 : 1 + (x - 0.2) / 0.8)) / 64);
  };
  ValidateCommandOptions o = options(samples(steps), "");
  o.domain = "x=0:1";
  o.pdf = "64*x - 2*rint(32*x-0.5) < 1 ? 0.4 : 1.6";
  o.breaks = "x=0:1:0.015625";
  const Output right = run(o);
  EXPECT_EQ(right.code, carlo::exit_ok) << right.text;
  o.pdf = "64*x - 2*rint(32*x-0.5) < 1 ? 0.5 : 1.5";
  EXPECT_EQ(run(o).code, carlo::exit_failed);
  o.breaks = "y=0.5";
  EXPECT_THAT(refusal(o), HasSubstr("--breaks: 'y' is no axis of the domain; it has x"));
  o.pdf = "";
  EXPECT_THAT(refusal(o), HasSubstr("--breaks is for a --pdf or a --command"));
}

TEST_F(SamplesFile, Detect_TooFewSamples_Throws) {
  ValidateCommandOptions o = options(samples(ramp), grid(16, 1, ramp_mean));
  o.detect = 0.2;
  EXPECT_THAT(run(o).text, HasSubstr("samples per case to detect 20 %"));
  o.detect = 0.001;
  EXPECT_THAT(refusal(o), HasSubstr("35556 samples can be counted, the others choose the bins; --detect 0.001 needs"));
}

TEST_F(SamplesFile, InvalidRow_NamesItsLine) {
  const std::string good = grid(16, 1, ramp_mean);
  const auto with = [&](const std::string& row) {
    return refusal(options(write("b.csv", "x,y\n0.5,0.5\n\n# note\n" + row + "\n0.1,0.2\n"), good));
  };
  EXPECT_THAT(with("0.1,zero"), HasSubstr("b.csv:5: 'zero' is not a number"));
  EXPECT_THAT(with("0.1,nan"), HasSubstr("b.csv:5: 'nan' is not a finite number"));
  EXPECT_THAT(with("0.1,1e999"), HasSubstr("b.csv:5: '1e999' is not a finite number"));
  EXPECT_THAT(with("0.1"), HasSubstr("b.csv:5: 1 numbers; the rows before have 2"));
  EXPECT_THAT(with("0.1,"), HasSubstr("b.csv:5: 1 numbers; the rows before have 2")) << "a comma may end a row";
  EXPECT_THAT(with("0.1,,0.2"), HasSubstr("b.csv:5: an empty field"));
  EXPECT_THAT(with("0.1,0.2x"), HasSubstr("b.csv:5: '0.2x' is not a number"));
  EXPECT_THAT(refusal(options(write("b.csv", "nan,1\n"), good)), HasSubstr("b.csv:1: 'nan'")) << "not a row of names";
  EXPECT_THAT(refusal(options(write("b.csv", "x,y\n"), good)), HasSubstr("b.csv: it contains no numbers"));
}

TEST_F(SamplesFile, InvalidFiles_AreOneLineErrors) {
  const std::string file = samples(ramp), good = grid(16, 1, ramp_mean);
  EXPECT_THAT(refusal(options(path("none.csv"), good)), HasSubstr("none.csv': no such file"));
  EXPECT_THAT(refusal(options(file, path("none.exr"))), HasSubstr("none.exr"));
  EXPECT_THAT(refusal(options(file, "")),
              HasSubstr("needs a density to compare the samples with: --pdf-file or --pdf"));
  EXPECT_THAT(refusal(options("", good)), HasSubstr("--pdf-file needs samples"));
  EXPECT_THAT(refusal(options(samples(ramp, "few.csv", 1999), good)),
              HasSubstr("few.csv: 1999 samples; at least 2000 are needed"));
  EXPECT_THAT(refusal(options(file, write("q.csv", "1,2\n3,-1\n"))),
              HasSubstr("q.csv:2: number 2 is -1; a density is >= 0"));
  EXPECT_THAT(refusal(options(file, write("q.csv", "0,0\n0,0\n"))), HasSubstr("q.csv: the density integrates to 0"));
  ValidateCommandOptions o = options(
      samples([](mc::Pcg& random) { return fmt::format("{}", random.uniform<double>()); }, "x.csv"), grid(4, 4, one));
  EXPECT_THAT(refusal(o), HasSubstr("p.csv: 4 rows; the density on an interval is one row"));
}

TEST_F(SamplesFile, SamplesOutsideGrid_AreOneLineErrors) {
  ValidateCommandOptions o = options(samples(ramp), grid(4, 4, one));
  o.domain = "x=0:0.5,y=0:1";
  EXPECT_THAT(refusal(o), testing::MatchesRegex(".*s\\.csv:[0-9]+: \\(0\\.[0-9]+, 0\\.[0-9]+\\) is not covered by the "
                                                "grid of .*p\\.csv, x in \\[0, 0\\.5\\], y in \\[0, 1\\]; "
                                                "[0-9]+ of 40000 samples are not \\(see --domain\\)"));
  o.domain = "sphere";
  EXPECT_THAT(refusal(o), HasSubstr("s.csv: 2 columns; 3 are needed on the unit sphere"));
  o.domain = "x=0:1";
  EXPECT_THAT(refusal(o), HasSubstr("s.csv: 2 columns; 1 is needed on x in [0, 1]"));
  o.domain = "x=1:0,y=0:1";
  EXPECT_THAT(refusal(o), HasSubstr("lo < hi is needed"));
  const auto long_vector = [](mc::Pcg& random) {
    double x, y, z;
    std::sscanf(cosine(random).c_str(), "%lf %lf %lf", &x, &y, &z);
    return fmt::format("{} {} {}", 1.001 * x, 1.001 * y, 1.001 * z);
  };
  EXPECT_THAT(refusal(options(samples(long_vector), grid(8, 32, cosine_mean))),
              HasSubstr("is not covered by the grid"));
}

// Formats of spreadsheets and their users: quoted, with a trailing comma, with comments; all are the same table.
TEST_F(SamplesFile, SpreadsheetFormats_AreRead) {
  const std::string file = samples(ramp), pdf = grid(16, 1, ramp_mean);
  std::string quoted = "\"x\",\"y\",\r\n";
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t comma = line.find(',');
    quoted += "\"" + line.substr(0, comma) + "\", \"" + line.substr(comma + 1) + "\",  # drawn\r\n";
  }
  const std::string plain = run(options(file, pdf)).text;
  const std::string same = run(options(write("s.csv", quoted), pdf)).text;
  EXPECT_EQ(same.substr(same.find("double"), 40), plain.substr(plain.find("double"), 40));
  EXPECT_THAT(refusal(options(write("b.csv", "0.1,0.1\n\"0.5,0.5\n"), pdf)),
              HasSubstr("b.csv:2: a quotation mark without its other"));
}

TEST_F(SamplesFile, BinaryGarbage_IsRejectedInPlainText) {
  const std::string pdf = grid(16, 1, ramp_mean);
  const std::string refused = refusal(options(write("b.csv", std::string("0.5\n\x7f\x45\x4c\x46\x00\x01", 10)), pdf));
  EXPECT_THAT(refused, HasSubstr("b.csv: it is not text: byte 8 is 0x00; rows of numbers are needed"));
  const std::string word = refusal(options(write("b.csv", "0.5\n\xc3\xa9\xff\n"), pdf));
  EXPECT_THAT(word, HasSubstr("b.csv:2: '\xc3\xa9?' is not a number"));
}

TEST_F(SamplesFile, Result_IsIndependentOfPath) {
  const std::string pdf = grid(16, 1, ramp_mean), a = samples(ramp);
  std::filesystem::create_directories(folder / "elsewhere");
  std::filesystem::copy(a, folder / "elsewhere" / "t.csv");
  const auto figures = [&](const std::string& file) {
    const std::string text = run(options(file, pdf)).text;
    return text.substr(text.find("double"), 40);
  };
  EXPECT_EQ(figures(a), figures(path("elsewhere/t.csv")));
}

// Correct samples in common print formats: rounded to the edge, without trailing zeros, with few digits.
TEST_F(SamplesFile, AnyNumberFormat_CorrectSamplesPass) {
  for (const std::string format : {"{:.2f}", "{:.3f}", "{:.4f}", "{:.3g}", "{:.4g}", "{:g}", "{:.17g}"}) {
    const auto uniform = [&](mc::Pcg& random) { return fmt::format(fmt::runtime(format), random.uniform<double>()); };
    const auto exponential = [&](mc::Pcg& random) {
      return fmt::format(fmt::runtime(format), -std::log(1 - random.uniform<double>()));
    };
    ValidateCommandOptions o = options(samples(uniform, "u.csv", 200'000), "");
    o.pdf = "1";
    o.domain = "x=0:1";
    EXPECT_EQ(run(o).code, carlo::exit_ok) << format << run(o).text;
    o = options(samples(exponential, "e.csv", 200'000), "");
    o.pdf = "exp(-x)";
    o.domain = "x=0:inf";
    EXPECT_EQ(run(o).code, carlo::exit_ok) << format << run(o).text;
    const auto disk = [&](mc::Pcg& random) {
      const double r = std::sqrt(random.uniform<double>()), phi = 2 * pi * random.uniform<double>();
      return fmt::format(fmt::runtime(fmt::format("{0},{0}", format)), r * std::cos(phi), r * std::sin(phi));
    };
    o = options(samples(disk, "d.csv", 200'000), "");
    o.pdf = "1/_pi";
    o.domain = "disk";
    EXPECT_EQ(run(o).code, carlo::exit_ok) << format << run(o).text;
  }
}

} // namespace
