// Every constructor and every function with data arguments rejects invalid input with a one-line message. The message
// names the subject, the value and the requirement.

#include "support/files.h"

#include <mc/check/check_subject.h>
#include <mc/check/fit/expected/cubature.h>
#include <mc/check/fit/expected/partition.h>
#include <mc/check/subject/make_subject.h>
#include <mc/domain/annulus.h>
#include <mc/domain/box.h>
#include <mc/domain/cap.h>
#include <mc/domain/interval.h>
#include <mc/domain/parallelogram.h>
#include <mc/estimate/adapt/importance_grid.h>
#include <mc/estimate/control_variate.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/mis.h>
#include <mc/estimate/moments.h>
#include <mc/estimate/russian_roulette.h>
#include <mc/sampler/latin_hypercube.h>
#include <mc/sampler/multi_jittered.h>
#include <mc/sampler/stratified.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/ks_test.h>
#include <mc/stats/power_law.h>
#include <mc/stats/t_test.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/table/table_dist_tree.h>
#include <mc/warp/annulus.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/cone.h>
#include <mc/warp/exponential.h>
#include <mc/warp/half_vector.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/mixture.h>
#include <mc/warp/normal.h>
#include <mc/warp/power.h>
#include <mc/warp/rotated.h>
#include <mc/warp/sphere_light.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/tent.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <gmock/gmock.h>

#include <algorithm>

namespace mc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
using V = Vec3<double>;
using Weights = std::vector<double>;

// A call that must fail, and substrings that its message must contain.
struct Row {
  std::function<void()> call;
  std::vector<std::string> says;
};

void expect_refused(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const std::string message = support::error_of(row.call);
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
    for (const std::string& part : row.says) EXPECT_THAT(message, testing::HasSubstr(part));
  }
}

// Adds rows for a parameter of one number. The message must contain each bad value.
template <class Make>
void add(std::vector<Row>& rows, const std::string& subject, const std::string& need, std::initializer_list<double> bad,
         Make make) {
  for (const double x : bad) rows.push_back({[=] { make(x); }, {subject + ":", fmt::format("{}", x), need}});
}

TEST(BadInput, WarpsOnTheLine) {
  std::vector<Row> rows;
  add(rows, "Linear", "finite, >= 0 and not both 0", {nan, inf, -1}, [](double x) { Linear<double>(x, 1); });
  add(rows, "Linear", "finite, >= 0 and not both 0", {nan, inf, -1, 0}, [](double x) { Linear<double>(0, x); });
  add(rows, "Tent", "finite", {nan, inf}, [](double x) { Tent<double>(x, 1); });
  add(rows, "Tent", "radius > 0", {nan, inf, 0, -1}, [](double x) { Tent<double>(0, x); });
  add(rows, "Exponential", "finite and > 0", {nan, inf, 0, -1, 1e-320}, [](double x) { Exponential<double>{x}; });
  add(rows, "TrimmedExponential", "finite", {nan, inf, -inf}, [](double x) { TrimmedExponential<double>(x, 1); });
  add(rows, "TrimmedExponential", "finite", {nan, inf, 0, -1}, [](double x) { TrimmedExponential<double>(1, x); });
  add(rows, "Normal", "finite", {nan, inf}, [](double x) { Normal<double>(x, 1); });
  add(rows, "Normal", "sigma > 0", {nan, inf, 0, -1}, [](double x) { Normal<double>(0, x); });
  add(rows, "Logistic", "scale > 0", {nan, inf, 0, -1}, [](double x) { Logistic<double>(0, x); });
  add(rows, "TrimmedLogistic", "finite and > 0", {nan, inf, 0, -1}, [](double x) { TrimmedLogistic<double>(x, 0, 1); });
  add(rows, "TrimmedLogistic", "lo < hi", {nan, inf, 0, -1}, [](double x) { TrimmedLogistic<double>(1, 0, x); });
  add(rows, "Power", "finite and >= 0", {nan, inf, -0.5}, [](double x) { Power<double>{x}; });
  expect_refused(rows);
}

TEST(BadInput, WarpsOnThePlaneAndTheSphere) {
  std::vector<Row> rows;
  add(rows, "Bilinear", "finite, >= 0 and not all 0", {nan, inf, -1, 0},
      [](double x) { Bilinear<double>(0, 0, x, 0); });
  add(rows, "IsotropicNormal", "finite and > 0", {nan, inf, 0, -1}, [](double x) { IsotropicNormal<double>{x}; });
  add(rows, "Annulus", "0 <= inner < outer", {nan, inf, 0.5, -1}, [](double x) { UniformAnnulus<double>(0.5, x); });
  add(rows, "Annulus", "0 <= inner < outer", {nan, -1}, [](double x) { UniformAnnulus<double>(x, 1); });
  add(rows, "UniformCone", "(0, pi]", {nan, inf, 0, -1, 3.2}, [](double x) { UniformCone<double>::from_angle(x); });
  add(rows, "UniformCone", "[-1, 1)", {nan, 1, -1.5}, [](double x) { UniformCone<double>::from_cos(x); });
  add(rows, "UniformCone", "(0, 1]", {nan, 0, -1, 1.5}, [](double x) { UniformCone<double>::from_sin2(x); });
  add(rows, "Cap", "(0, 2]", {nan, 0, -1, 2.5}, [](double x) { UniformCone<double>::from_one_minus_cos(x); });
  add(rows, "BlinnPhong", "finite and >= 0", {nan, inf, -1}, [](double x) { BlinnPhong<double>{x}; });
  add(rows, "HenyeyGreenstein", "(-1, 1)", {nan, 1, -1, 1.5}, [](double x) { HenyeyGreenstein<double>{x}; });
  add(rows, "VonMisesFisher", "finite and >= 0", {nan, inf, -1}, [](double x) { VonMisesFisher<double>{x}; });
  add(rows, "BeckmannVisibleNormals", "unit vector", {nan, inf, 0, 2},
      [](double x) { BeckmannVisibleNormals<double>(V(0, 0, x), 0.1); });
  add(rows, "BeckmannNormals", "[1e-6, 1000]", {nan, inf, 0, -1, 2000},
      [](double x) { BeckmannNormals<double>(0.1, x); });
  add(rows, "TrowbridgeReitz", "[1e-6, 1000]", {nan, inf, 0, -1, 2000},
      [](double x) { TrowbridgeReitzNormals<double>(x, 0.1); });
  add(rows, "TrowbridgeReitzVisibleNormals", "unit vector with z >= 0", {nan, -1, 2},
      [](double x) { TrowbridgeReitzVisibleNormals<double>(V(0, 0, x), 0.1); });
  add(rows, "Reflected", "unit vector", {nan, inf, 0, 2},
      [](double x) { Reflected(V(0, 0, x), BeckmannNormals<double>(0.1)); });
  add(rows, "RefractedIn", "[1.0001, 10000]", {nan, inf, 0.5, 1, -2},
      [](double x) { RefractedIn(V(0, 0, 1), BeckmannNormals<double>(0.1), x); });
  add(rows, "RefractedOut", "[0.0001, 0.9999]", {nan, 0, 1, 1.5, -2},
      [](double x) { RefractedOut(V(0, 0, 1), BeckmannNormals<double>(0.1), x); });
  add(rows, "SphereLight", "finite and > 0", {nan, inf, 0, -1}, [](double x) { SphereLight<double>(V(0, 0, 1), x); });
  rows.push_back({[] { SphereLight<double>(V(0, nan, 1), 1); }, {"SphereLight:", "nan"}});
  rows.push_back({[] { Rotated(CosineHemisphere<double>{}, V(0, 0, 2)); }, {"Rotated:", "length^2 4", "unit vector"}});
  rows.push_back({[] { Rotated(CosineHemisphere<double>{}, V(nan, 0, 1)); }, {"Rotated:", "nan", "unit vector"}});
  rows.push_back(
      {[] { SphericalTriangle<double>(V(0, 0, nan), V(1, 0, 0), V(0, 1, 0)); }, {"Patch:", "nan", "finite and > 0"}});
  rows.push_back({[] { SphericalTriangle<double>(V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)); },
                  {"Patch:", "volume of 0", "finite and > 0"}});
  rows.push_back({[] { SphericalRectangle<double>(V(0, 0, 1), V(1, 0, 0), V(2, 0, 0)); },
                  {"Patch:", "volume of 0", "finite and > 0"}});
  const auto mixture = [](double a, double b) {
    return [=] { Mixture(std::array{a, b}, UniformHemisphere<double>{}, CosineHemisphere<double>{}); };
  };
  rows.push_back({mixture(1, nan), {"Mixture:", "weights[1] = nan", "finite and >= 0"}});
  rows.push_back({mixture(-1, 1), {"Mixture:", "weights[0] = -1", "finite and >= 0"}});
  rows.push_back({mixture(0, 0), {"Mixture:", "all 2 weights are 0", "at least one must be > 0"}});
  expect_refused(rows);
}

TEST(BadInput, Domains) {
  std::vector<Row> rows;
  add(rows, "Interval", "lo < hi", {nan, inf, 0, -1}, [](double x) { Interval<double>(0, x); });
  add(rows, "Interval", "lo < hi", {nan, -inf, 1, 2}, [](double x) { Interval<double>(x, 1); });
  add(rows, "HalfLine", "finite", {nan, inf, 0}, [](double x) { HalfLine<double>(0, x); });
  add(rows, "RealLine", "scale > 0", {nan, inf, 0, -1}, [](double x) { RealLine<double>(0, x); });
  add(rows, "Box", "lo < hi", {nan, inf, 0, -1}, [](double x) { Box<double, 2>({0, 0}, {1, x}); });
  rows.push_back({[] { Box<double, Eigen::Dynamic>(Eigen::VectorXd(0), Eigen::VectorXd(0)); },
                  {"Box:", "dimension 0", "at least 1"}});
  rows.push_back({[] { Box<double, Eigen::Dynamic>(Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(3)); },
                  {"Box:", "2 and 3", "the same"}});
  rows.push_back({[] { Parallelogram<double>(V(0, 0, 0), V(1, 0, 0), V(2, 0, 0)); },
                  {"Parallelogram:", "area of 0", "finite and > 0"}});
  rows.push_back(
      {[] { Parallelogram<double>(V(0, nan, 0), V(1, 0, 0), V(0, 1, 0)); }, {"Parallelogram:", "coordinate 1", "nan"}});
  expect_refused(rows);
}

TEST(BadInput, TablesAndSamplers) {
  std::vector<Row> rows;
  const auto tables = [&](const Weights& w, const std::vector<std::string>& says) {
    rows.push_back({[=] { TableDist1D<float>{w}; }, says});
    rows.push_back({[=] { AliasTable{w}; }, says});
    rows.push_back({[=] { TableDist2D<float>(w, w.size(), 1); },
                    w.empty() ? std::vector<std::string>{"TableDist2D:", "0x1 cells"} : says});
  };
  tables({}, {"table:", "no weights", "at least one is needed"});
  tables({0, 0, 0}, {"all 3 weights are 0", "at least one must be > 0"});
  tables({1, nan}, {"weights[1] = nan", "not finite and >= 0"});
  tables({1, 2, inf}, {"weights[2] = inf", "not finite and >= 0"});
  tables({-5, 1}, {"weights[0] = -5", "not finite and >= 0"});
  rows.push_back({[] { TableDist2D<float>(Weights{1, 2, 3}, 2, 2); }, {"TableDist2D:", "3 weights", "4 are needed"}});
  rows.push_back({[] {
                    TableDist2D<float>::from_lat_long(Weights{1, 2, 3}, 2, 2);
                  },
                  {"TableDist2D:", "3 weights", "4 are needed"}});
  rows.push_back({[] { TableDist1D<double>(Weights{1}, {2, 1}); }, {"Interval:", "[2, 1]", "lo < hi"}});
  rows.push_back({[] { TableDist1D<double>::from_function([](double) { return 1.0; }, 0); }, {"table:", "no weights"}});
  rows.push_back({[] { TableDist1D<double>::from_function([](double x) { return x - 1; }, 2); },
                  {"weights[0] = -0.75", "not finite and >= 0"}});
  rows.push_back({[] { BoxTree(0); }, {"BoxTree:", "dimension 0", "at least 1"}});
  rows.push_back({[] {
                    BoxTree(2, std::vector<BoxTreeNode>{{BoxTreeNode::leaf, nan}});
                  },
                  {"BoxTree:", "node 0", "nan"}});
  rows.push_back({[] { TableDistTree<float, 3>(BoxTree(2)); }, {"TableDistTree:", "2 dimensions", "3 are needed"}});
  rows.push_back({[] { Stratified(0, 1, 2); }, {"Stratified:", "count 0", "at least 1"}});
  rows.push_back({[] { Stratified(4, 1, 0); }, {"Stratified:", "group 0", "at least 1"}});
  rows.push_back({[] { LatinHypercube(0, 1); }, {"LatinHypercube:", "count 0", "at least 1"}});
  rows.push_back({[] { MultiJittered(0, 1); }, {"MultiJittered:", "count 0", "[1, 2^31]"}});
  expect_refused(rows);
}

TEST(BadInput, Integrate) {
  std::vector<Row> rows;
  const auto f = [](std::span<const double> u) { return u[0]; };
  const auto refuses = [&](std::vector<std::string> says, auto change, int dim = 2) {
    IntegrateOptions o;
    change(o);
    says.insert(says.begin(), "integrate:");
    rows.push_back({[=] { integrate_unit(f, dim, o); }, says});
  };
  const auto nothing = [](IntegrateOptions&) {};
  refuses({"dimension 0", "at least 1"}, nothing, 0);
  refuses({"dimension -3", "at least 1"}, nothing, -3);
  for (const double bad : {-1e-3, nan, inf}) {
    refuses({"tolerances", fmt::format("{} (relative)", bad), ">= 0"}, [&](IntegrateOptions& o) { o.rel_error = bad; });
    refuses({"tolerances", fmt::format("{} (absolute)", bad), ">= 0"}, [&](IntegrateOptions& o) { o.abs_error = bad; });
  }
  for (const Method method : {Method::plain, Method::stratified, Method::rqmc, Method::vegas, Method::automatic})
    for (const std::uint64_t calls : {0, 1})
      refuses({fmt::format("max_calls {}", calls), "at least"}, [&](IntegrateOptions& o) {
        o.method = method;
        o.max_calls = calls;
      });
  for (const double bad : {0.0, 1.0, -1.0, nan})
    refuses({fmt::format("confidence {}", bad), "(0, 1)"}, [&](IntegrateOptions& o) { o.confidence = bad; });
  for (const std::uint32_t bad : {0u, 1u, 2000000u})
    refuses({fmt::format("{} replicates", bad), "between 2 and 2^20"},
            [&](IntegrateOptions& o) { o.replicates = bad; });
  refuses({"threads -1", ">= 0"}, [](IntegrateOptions& o) { o.threads = -1; });
  rows.push_back({[] { integrate_unit(std::function<double(std::span<const double>)>(), 2); },
                  {"integrate:", "empty function", "callable"}});
  rows.push_back({[] { integrate_unit(VectorIntegrand(), 1, 2); }, {"integrate:", "empty function", "callable"}});
  rows.push_back({[] { integrate_unit([](auto, auto) {}, 0, 2); }, {"integrate:", "0 outputs", "at least 1"}});
  rows.push_back(
      {[] { integrate([](double x) { return x; }, Interval<double>(0, nan)); }, {"Interval:", "nan", "lo < hi"}});
  rows.push_back({[=] { integrate_rqmc(f, 2, 0); }, {"integrate_rqmc:", "0 points", "between 1 and 2^32"}});
  rows.push_back({[=] { integrate_rqmc(f, 0, 64); }, {"integrate:", "dimension 0"}});
  rows.push_back({[=] { integrate_rqmc(f, 2, 64, 1); }, {"integrate:", "1 replicates"}});
  rows.push_back({[] { parse_method("vega"); }, {"unknown method 'vega'", "did you mean 'vegas'?"}});
  // Values that are not finite: the message contains their number and the first point.
  for (const Method method : {Method::plain, Method::stratified, Method::rqmc, Method::vegas, Method::automatic}) {
    IntegrateOptions o;
    o.method = method;
    rows.push_back({[=] { integrate_unit([](std::span<const double> u) { return u[0] < 0.5 ? nan : 1.0; }, 2, o); },
                    {"integrate:", "not finite at", "the first at u = (0.", "must be finite almost everywhere"}});
    rows.push_back({[=] { integrate_unit([](std::span<const double> u) { return u[0] < 0.01 ? inf : 1.0; }, 2, o); },
                    {"integrate:", "not finite at", "the first at u = (0.0", "must be finite almost everywhere"}});
  }
  expect_refused(rows);
}

TEST(BadInput, Estimators) {
  std::vector<Row> rows;
  add(rows, "russian_roulette", "(0, 1]", {nan, 0, -1, 1.5}, [](double x) { russian_roulette(x, 0.5); });
  add(rows, "split", "(0, 2^20]", {nan, inf, 0, -1}, [](double x) { split(x, 0.5); });
  add(rows, "Heuristic", "> 0", {nan, 0, -1}, [](double x) { Heuristic<double>::power(x); });
  add(rows, "Heuristic", "[0, 1]", {nan, -1, 1.5}, [](double x) { Heuristic<double>::cutoff(x); });
  add(rows, "MultipleImportance", "finite and >= 0", {nan, inf, -1}, [](double x) {
    MultipleImportance(std::array{1.0, x}, Heuristic<double>{}, UniformHemisphere<double>{},
                       CosineHemisphere<double>{});
  });
  add(rows, "ControlVariates", "finite", {nan, inf}, [](double x) { ControlVariates(std::array{x}); });
  add(rows, "Estimate", "(0, 1)", {nan, 0, 1, -1}, [](double x) { Estimate{}.interval(x); });
  rows.push_back({[] { ImportanceGrid(0); }, {"ImportanceGrid:", "dimension 0", "at least 1"}});
  Moments one, bad;
  one.add(1);
  bad.add(1);
  bad.add(2);
  bad.add(nan, 17);
  rows.push_back({[=] { one.estimate(); }, {"Moments:", "1 values", "at least 2"}});
  rows.push_back({[=] { bad.estimate(); }, {"Moments:", "1 of 3 values", "first at index 17"}});
  expect_refused(rows);
}

TEST(BadInput, Checkers) {
  std::vector<Row> rows;
  Moments two;
  two.add(1);
  two.add(2);
  add(rows, "t_test", "finite", {nan, inf}, [=](double x) { t_test(two, x); });
  add(rows, "t_test", "(0, 1)", {nan, 0, 1}, [=](double x) { t_test(two, 1, x); });
  rows.push_back({[] { chi_square({1, 2}, {3}); }, {"chi_square:", "2 counts for 1"}});
  rows.push_back({[] { chi_square({1, 2}, {1, nan}); }, {"chi_square:", "expected[1] = nan", "finite and >= 0"}});
  rows.push_back({[] { chi_square({1, 2}, {10, 10}); }, {"chi_square:", "3 observed, 20 expected", "must agree"}});
  rows.push_back({[] { chi_square({0, 0}, {0, 0}); }, {"chi_square:", "no samples in 2 cells", "at least one"}});
  rows.push_back({[] { rms_error(16, std::array{1.0}, 1); }, {"rms_error:", "1 estimates", "at least 2"}});
  rows.push_back({[] { rms_error(16, std::array{1.0, nan}, 1); }, {"rms_error:", "estimates[1] = nan", "not finite"}});
  rows.push_back({[] { rms_error(16, std::array{1.0, 2.0}, inf); }, {"rms_error:", "truth inf", "finite"}});
  const auto law = [](double n, double rms) {
    return [=] { fit_power_law(std::array{RmsError{16, 1}, RmsError{32, 1}, RmsError{n, rms}}, 10); };
  };
  rows.push_back({law(0, 1), {"fit_power_law:", "N = 0", "> 0"}});
  rows.push_back({law(64, nan), {"fit_power_law:", "at N = 64 is nan", "> 0"}});
  rows.push_back({[] {
                    fit_power_law(std::array{RmsError{16, 1}, RmsError{16, 1}, RmsError{16, 1}}, 10);
                  },
                  {"fit_power_law:", "N = 16", "two different"}});
  rows.push_back({[] { Partition({}, 0, 3); }, {"Partition:", "dim 0", "1..6"}});
  rows.push_back({[] { ks_test({}, [](double x) { return x; }); }, {"ks_test:", "no samples"}});
  rows.push_back({[] {
                    ks_test({0.5, nan}, [](double x) { return x; });
                  },
                  {"ks_test:", "samples[1] = nan", "not finite"}});
  rows.push_back(
      {[] { integrate_boxes([](const auto&) { return 1.0; }, 4, {}); }, {"integrate_boxes:", "dim 4", "1..3"}});
  const Subject subject = make_subject("cosine", CosineHemisphere<double>{});
  rows.push_back(
      {[=] { check_subject(subject, {.samples = 10}); }, {"check_subject:", "samples = 10", "at least 1000"}});
  rows.push_back({[=] { check_subject(subject, {.alpha = nan}); }, {"check_subject:", "alpha = nan", "(0, 1)"}});
  expect_refused(rows);
}

} // namespace
} // namespace mc
