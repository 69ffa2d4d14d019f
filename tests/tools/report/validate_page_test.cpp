// The page of carlo validate: its content, and the result in a headless browser.

#include <catalogue/catalogue.h>
#include <cli/validate.h>
#include <report/validate_output.h>
#include <report/validate_page.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include <tools/browser.h>
#include <tools/unpacked.h>

namespace {

namespace fs = std::filesystem;
using support::logged;
using testing::HasSubstr, testing::Not;

constexpr std::uint64_t samples = 60'000;

// Right and wrong samplers of different kinds and their reports, in the form that validate produces.
struct Results {
  std::vector<carlo::Case> cases;
  std::vector<mc::Report> reports;
  carlo::ValidationSettings settings;

  std::vector<const carlo::Case*> pointers() const {
    std::vector<const carlo::Case*> p;
    for (const carlo::Case& c : cases) p.push_back(&c);
    return p;
  }
  void add(const std::string& name, const std::string& parameters, const mc::Subject& subject) {
    cases.push_back({name, parameters, "double", {}});
    reports.push_back(check_subject(subject, {.samples = samples, .evidence = true}));
  }
};

const Results& results() {
  static const Results made = [] {
    using V = mc::Vec3<double>;
    Results r;
    r.settings.command = "carlo validate </script> & \"quotes\"";
    r.settings.samples = samples;
    const mc::Hemisphere<double> hemisphere;
    const auto cosine = [](double exponent) {
      return [exponent](mc::Pcg& random) {
        const double z = std::pow(random.uniform<double>(), 1 / (1 + exponent)),
                     phi = 2 * mc::pi<double> * random.uniform<double>();
        return mc::spherical_direction<double>(std::sqrt(1 - z * z), z, phi);
      };
    };
    const auto pdf = [](const V& w) { return w.z() > 0 ? w.z() / mc::pi<double> : 0.0; };
    r.add("RightCosine", "exponent=1", make_subject("right", hemisphere, cosine(1), pdf));
    r.add("WrongCosine", "exponent=1.1", make_subject("wrong", hemisphere, cosine(1.1), pdf));
    const auto tent = [](mc::Pcg& random) { return random.uniform<double>() + random.uniform<double>() - 1; };
    r.add("Tent", "on [-1,1]",
          make_subject("tent", mc::Interval<double>{-1, 1}, tent, [](double x) { return 1 - std::abs(x); }));
    mc::Subject dice;
    dice.name = "dice";
    dice.atoms.assign(6, 1.0 / 6);
    dice.draw = [](std::uint64_t seed, std::size_t n, std::vector<mc::Subject::Draw>& out) {
      mc::Pcg random(seed);
      for (std::size_t i = 0; i < n; ++i) {
        out.emplace_back().kind = mc::Subject::Draw::Kind::atom;
        out.back().atom = static_cast<int>(6 * random.uniform<double>());
      }
    };
    r.add("Dice", "", dice);
    return r;
  }();
  return made;
}

struct ValidatePage : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / ("carlo_page_" + std::to_string(::getpid()));
  std::string file = (folder / "index.html").string();
  void SetUp() override {
    fs::create_directories(folder);
    const std::vector<const carlo::Case*> cases = results().pointers();
    mc::write_file(file, carlo::validation_page({results().settings, cases, results().reports}));
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string browse(const std::string& hash) const { return support::browse(file, hash); }
};

// A separate function, so that a failure names the missing text without printing the whole page.
bool has(const std::string& dom, const std::string& text) { return dom.find(text) != std::string::npos; }

TEST_F(ValidatePage, LoadsNothing) {
  const std::string text = mc::read_file(file);
  for (const char* loaded :
       {"src=", "url(", "@import", "fetch(", "XMLHttpRequest", "http://www.w3.org/1999", "https://"})
    EXPECT_FALSE(has(text, loaded)) << loaded;
  for (const char* mark : {"@CSS@", "@DATA@", "@MAPS@", "@JS@"}) EXPECT_THAT(text, Not(HasSubstr(mark)));
  EXPECT_THAT(text, HasSubstr("carlo validate \\u003c/script>")) << "data cannot end its element";
}

TEST_F(ValidatePage, PackedTreesAreComplete) {
  const mc::PlotData& evidence = *results().reports[0].evidence;
  const std::size_t n = evidence.cells.size();
  const std::string all = support::unpacked(carlo::pack_tree(evidence, 2, 4096)),
                    few = support::unpacked(carlo::pack_tree(evidence, 2, 33));
  EXPECT_EQ(all.size(), n - 1 + 4 * (3 * n - 1));
  EXPECT_EQ(few.size(), 31u + 4 * (3 * 32 - 1)) << "a power of two";
  EXPECT_EQ(few.substr(0, 31), all.substr(0, 31));
  EXPECT_THAT(all, testing::StartsWith("011")) << "axes alternate";
}

// 446 cases like these are 3 MB at most.
TEST_F(ValidatePage, CasesThatPassAreSmall) {
  const auto size_of = [&](std::size_t count) {
    const std::vector<const carlo::Case*> cases(count, &results().cases[0]);
    const std::vector<mc::Report> reports(count, results().reports[0]);
    mc::write_file(file, carlo::validation_page({results().settings, cases, reports}));
    return mc::read_file(file).size();
  };
  EXPECT_LE(size_of(2) - size_of(1), 3'000'000u / 446);
}

// In a browser: failures first, search, order and maps. Each test loads the page once, which takes about a second.
TEST_F(ValidatePage, FailuresComeFirstAndOpen) {
  const std::string dom = browse("");
  if (dom.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(logged(dom), "");
  EXPECT_TRUE(has(dom, "1 of 4 cases fails"));
  EXPECT_LT(dom.find("WrongCosine</b>"), dom.find("RightCosine</b>"));
  EXPECT_TRUE(has(dom, "<b>Likely cause: </b>shape"));
  EXPECT_TRUE(has(dom, "carlo validate 'WrongCosine(exponent=1.1)' --scalar double --seed 1 --samples 60000"));
  for (const char* map : {"observed map", "expected map", "residual map"}) {
    const std::size_t at = dom.find(fmt::format("aria-label=\"{}\"", map));
    ASSERT_NE(at, std::string::npos) << map;
    EXPECT_TRUE(has(dom.substr(at, dom.find('>', at) - at), "data-cells=\"256\"")) << dom.substr(at, 200);
  }
  EXPECT_TRUE(has(dom, "<circle"));
  EXPECT_TRUE(has(dom, "cell theta") || has(dom, "<td>theta")) << "the worst cells have their coordinates";
}

TEST_F(ValidatePage, SearchFilters) {
  const std::string dom = browse("q=tent%20double");
  if (dom.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(logged(dom), "");
  EXPECT_TRUE(has(dom, "Tent</b>"));
  EXPECT_FALSE(has(dom, "Cosine</b>"));
}

TEST_F(ValidatePage, ColumnsSortAndEveryCaseOpens) {
  const std::string dom = browse("sort=name&desc=1&open=0,2,3&map=equal");
  if (dom.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(logged(dom), "");
  const auto at = [&](const char* name) { return dom.find(std::string(name) + "</b>"); };
  EXPECT_LT(at("WrongCosine"), at("Tent"));
  EXPECT_LT(at("Tent"), at("RightCosine"));
  EXPECT_LT(at("RightCosine"), at("Dice"));
  EXPECT_TRUE(has(dom, "aria-sort=\"descending\""));
  EXPECT_TRUE(has(dom, "6 cells")) << "the dice";
}

TEST_F(ValidatePage, FitsAPhone) { support::expect_fits_a_phone(file, "open=0,1,2,3"); }

TEST(ValidateReport, UnwritableFolder_IsRejectedBeforeTheWork) {
  carlo::ValidateCommandOptions o;
  o.names = {"UniformDisk"};
  const std::string file = (fs::path(testing::TempDir()) / "carlo_in_the_way").string();
  mc::write_file(file, "mine");
  for (const std::string& place : {file, file + "/report", std::string("/proc/report")}) {
    o.report = place;
    try {
      carlo::run_validate(o);
      ADD_FAILURE() << place << " accepted";
    } catch (const mc::Error& e) {
      EXPECT_THAT(e.what(), testing::AllOf(HasSubstr(place), Not(HasSubstr("\n"))));
    }
  }
  EXPECT_EQ(mc::read_file(file), "mine");
  fs::remove(file);
}

} // namespace
