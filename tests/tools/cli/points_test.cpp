// carlo points: sets by name and from a file, output files, bad input.

#include <tools/run_carlo.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace {

using support::ProcessResult;
using support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::size_t squares(const std::string& svg) {
  std::size_t paths = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++paths;
  return paths;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found(1);
  for (const char c : line) {
    if (c == ',') found.emplace_back();
    else found.back() += c;
  }
  return found;
}

// The values of a named column.
std::vector<std::string> column(const std::string& file, const std::string& name) {
  std::istringstream text(mc::read_file(file));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = fields(line);
  const auto at = std::find(names.begin(), names.end(), name) - names.begin();
  std::vector<std::string> values;
  while (std::getline(text, line)) values.push_back(fields(line).at(static_cast<std::size_t>(at)));
  return values;
}

std::string last_of(const std::string& file, const std::string& name) { return column(file, name).back(); }

struct Points : support::ScratchTest {
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const ProcessResult run = run_carlo("points " + arguments + " -o '" + path("out") + "'");
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr(words));
  }
};

TEST_F(Points, NamedSet_IsAnalysed) {
  const ProcessResult run = run_carlo("points sobol -n 64 -d 3 --randomisations 4 -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("sobol: 64 points in 3 dimensions"), HasSubstr("L2-star discrepancy"),
                                HasSubstr("mean of 4"), HasSubstr("-net in base 2")));
  const std::string csv = mc::read_file(path("out/points.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 64);
  EXPECT_THAT(mc::read_file(path("out/quality.csv")),
              AllOf(HasSubstr("\n16,"), HasSubstr("\n32,"), HasSubstr("\n64,")));
  EXPECT_THAT(mc::read_file(path("out/quality.json")), HasSubstr("\"star_upper\""));
  EXPECT_EQ(squares(mc::read_file(path("out/points.svg"))), 3u) << "a square for each pair of axes";
}

// Each measure has reference values for random and jittered points at every N. A random set matches its own reference.
TEST_F(Points, EveryFigureHasItsRandomAndJitteredExpectation) {
  const ProcessResult run = run_carlo("points random -n 256 --randomisations 64 -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const auto value = [&](const std::string& name, std::size_t row) {
    const std::vector<std::string> all = column(path("out/quality.csv"), name);
    EXPECT_EQ(all.size(), 5u);
    return std::stod(all.at(row));
  };
  for (std::size_t row = 0; row < 5; ++row) {
    EXPECT_NEAR(value("l2_star", row), value("l2_star_random", row), 0.2 * value("l2_star", row));
    for (const std::string name : {"centered", "wraparound", "mixture"}) {
      EXPECT_NEAR(value(name, row), value(name + "_random", row), 0.2 * value(name, row));
      EXPECT_LT(value(name + "_jittered", row), value(name + "_random", row));
    }
    EXPECT_NEAR(value("distance_periodic", row), value("distance_random", row), 0.6 * value("distance_random", row));
    EXPECT_NEAR(value("power_low", row), 1, 0.3);
    EXPECT_EQ(value("power_low_random", row), 1);
    EXPECT_LT(value("power_low_jittered", row), 0.6);
    EXPECT_EQ(value("star_lower", row), value("star_upper", row));
    EXPECT_EQ(value("star_random_lower", row), value("star_random_upper", row));
    EXPECT_NEAR(value("star_lower", row), value("star_random_lower", row), 0.7 * value("star_random_lower", row));
    EXPECT_LT(value("star_jittered_lower", row), value("star_random_lower", row));
    EXPECT_GT(value("distance_jittered", row), value("distance_random", row));
    EXPECT_LT(value("t_jittered", row), value("t_random", row));
  }
  EXPECT_EQ(column(path("out/spectrum.csv"), "n").front(), "16");
  EXPECT_EQ(column(path("out/spectrum.csv"), "n").back(), "256");
  EXPECT_EQ(column(path("out/spectrum.csv"), "random").back(), "1");
}

// Plots t over N; a number of points that is no power of 2 has no t.
TEST_F(Points, PlotsTOfTheNetOverN) {
  const ProcessResult run = run_carlo("points sobol -n 100 --randomisations 1 -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(column(path("out/quality.csv"), "t"), (std::vector<std::string>{"0", "0", "0", ""}));
  EXPECT_THAT(mc::read_file(path("out/quality.gp")), HasSubstr("using \"n\":\"t\" "));
}

// If the star discrepancy is too expensive, bounds are printed and drawn.
TEST_F(Points, PrintsBoundsOfTheStarDiscrepancy) {
  const ProcessResult run = run_carlo("points sobol -n 64 -d 12 --randomisations 1 -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("star discrepancy, bounds"));
  EXPECT_LT(std::stod(last_of(path("out/quality.csv"), "star_lower")),
            std::stod(last_of(path("out/quality.csv"), "star_upper")));
  EXPECT_THAT(mc::read_file(path("out/quality.gp")),
              AllOf(HasSubstr("lower and upper bounds"), HasSubstr("\"star_random_upper\""),
                    HasSubstr("title \"this set, bounds\""), HasSubstr("title \"random, bounds\"")));
}

// The printed number of axes agrees with the drawing.
TEST_F(Points, ManyAxes_FirstEightAreDrawn) {
  const ProcessResult run = run_carlo("points sobol -n 16 -d 12 --randomisations 1 -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("points.svg shows the first 8 of 12 axes, 28 of 66 pairs\n"));
  EXPECT_EQ(squares(mc::read_file(path("out/points.svg"))), 28u);
  EXPECT_THAT(run_carlo("points sobol -n 16 -d 8 --randomisations 1 -o '" + path("out") + "'").output,
              Not(HasSubstr("points.svg")));
  EXPECT_THAT(run_carlo("points --help").output, HasSubstr("first 8 axes"));
}

// points.csv contains the set: when it is read back, it has the same measures.
TEST_F(Points, PointsFile_IsAnalysedUnchanged) {
  run_carlo("points halton -n 50 --randomisations 1 -o '" + path("a") + "'");
  const ProcessResult run = run_carlo("points --points-file '" + path("a/points.csv") + "' -o '" + path("b") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("50 points in 2 dimensions"), HasSubstr("no power of 2")));
  const auto last = [&](const std::string& name) {
    const std::string text = mc::read_file(path(name + "/quality.csv"));
    return text.substr(text.rfind('\n', text.size() - 2) + 1);
  };
  EXPECT_EQ(last("a"), last("b"));
}

// A closed file of another program: its range becomes [0, 1), and carlo tells.
TEST_F(Points, ClosedFile_IsRescaled) {
  const std::string closed = write("closed.csv", "-1,1\n0,0.5\n1,-1\n0.5,0\n");
  const auto measured = [&](const std::string& range) {
    const ProcessResult run =
        run_carlo("points --points-file '" + closed + "' --rescale=" + range + " -o '" + path("out") + "'");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return run.output;
  };
  EXPECT_THAT(measured("-1:1"),
              HasSubstr("closed.csv: [-1, 1] rescaled to [0, 1); 2 coordinates at the upper end became "
                        "1 - 2^-53\n"));
  EXPECT_EQ(mc::read_file(path("out/points.csv")), "0,0.9999999999999999\n0.5,0.75\n0.9999999999999999,0\n0.75,0.5\n");
  EXPECT_THAT(measured("auto"), HasSubstr("closed.csv: the range of each column rescaled to [0, 1); 2 coordinates"));
  EXPECT_THAT(measured("-3:5"), HasSubstr("; 0 coordinates at the upper end"));
  const std::string file = "--points-file '" + closed + "' ";
  expect_refused(file, "closed.csv:1: coordinate 1 is -1; it must lie in [0, 1); for points in another range give "
                       "--rescale, as in --rescale=-1:1");
  expect_refused(file + "--rescale 0:1", "closed.csv:1: coordinate 1 is -1; it must lie in [0, 1] of --rescale");
  expect_refused(file + "--rescale 1:1", "--rescale '1:1' must be LO:HI with numbers LO < HI, as in 0:1, or auto");
  expect_refused(file + "--rescale wide", "--rescale 'wide' must be");
  expect_refused("--points-file '" + write("flat.csv", "0.5,1\n0.5,2\n") + "' --rescale auto",
                 "--rescale auto: column 1 has the range 0.5 to 0.5; give LO:HI");
  expect_refused("sobol --rescale 0:1", "--rescale is for a --points-file");
}

// No distance exceeds 0, so none can be drawn on a logarithmic axis.
TEST_F(Points, EqualPoints_HaveDistanceZero) {
  const std::string twins = write("twins.csv", "0.25,0.5\n0.75,0.125\n0.25,0.5\n");
  const ProcessResult run = run_carlo("points --points-file '" + twins + "' -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(last_of(path("out/quality.csv"), "distance_periodic"), "0");
}

TEST_F(Points, Underflow_IsPrintedAsZero) {
  const ProcessResult run = run_carlo("points --points-file '" + write("small.csv", "1e-400,0.5\n0.75,0.125\n0,0.5\n") +
                                      "' -o '" + path("out") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(last_of(path("out/quality.csv"), "distance_periodic"), "0") << "the first is the third";
}

TEST_F(Points, ResultsDoNotDependOnThreads) {
  for (const char* threads : {"1", "2"})
    run_carlo(std::string("points lattice -n 40 --randomisations 3 --threads ") + threads + " -o '" + path(threads) +
              "'");
  EXPECT_EQ(mc::read_file(path("1/quality.csv")), mc::read_file(path("2/quality.csv")));
  EXPECT_EQ(mc::read_file(path("1/spectrum.csv")), mc::read_file(path("2/spectrum.csv")));
}

TEST_F(Points, BadInput_IsReportedInOneLine) {
  expect_refused("sobl", "unknown point set 'sobl'; did you mean 'sobol'?");
  expect_refused("", "give a point set (see --list) or --points-file");
  for (const char* of_a_set : {" -n 64", " -d 3", " --seed 2", " --randomisations 4"})
    expect_refused(std::string("--points-file p.csv") + of_a_set, "--points-file and --");
  expect_refused("sobol -n 1", "-n 1 must lie in [2, 32768]");
  expect_refused("sobol -d 0", "-d 0 must lie in [1, 16]");
  expect_refused("sobol --randomisations 0", "--randomisations 0");
  expect_refused("--points-file '" + path("none.csv") + "'", "no such file");
  expect_refused("--points-file '" + write("one.csv", "0.5,0.5\n") + "'", "one.csv: 1 points; 2 to 32768 are needed");
  expect_refused("--points-file '" + write("off.csv", "x,y\n0.5,0.5\n0.25,1\n") + "'",
                 "off.csv:3: coordinate 2 is 1; it must lie in [0, 1)");
  expect_refused("--points-file '" + write("bad.csv", "0.5,0.5\n0.25\n") + "'", "bad.csv:2: 1 numbers");
  write("file", "");
  const ProcessResult run = run_carlo("points sobol -o '" + path("file") + "'");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_THAT(run.output, HasSubstr("cannot"));
}

} // namespace
