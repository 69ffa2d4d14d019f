// The page of carlo converge and carlo trade: integrals and scenes, and the result in a headless browser.

#include <converge/page.h>

#include <support/files.h>
#include <tools/browser.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <filesystem>

namespace {

using namespace carlo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

mc::RmsError error(double n, double rms, double seconds) { return {n, rms, 0.9 * rms, 1.1 * rms, seconds}; }

SamplingMethod named(const char* name) {
  SamplingMethod method;
  method.name = name;
  return method;
}

/// Two methods on a scene of 4x3 pixels, the second with a bias.
struct PictureExample {
  IntegralTarget target;
  PictureMeasurement pictures;
  TradeResults trade_results;

  PictureExample() {
    target.integral = {"a <room>", "a <room>", "rooms/a.xml", 0, 0, {}, 0, {}};
    for (const char* name : {"mis independent", "light sobol"}) pictures.methods.push_back(named(name));
    Measurement& m = pictures.measurement;
    m.cost = ray_cost;
    for (const SamplingMethod& w : pictures.methods) {
      ConvergenceCurve c;
      c.method = &w;
      c.errors = {error(4, 0.2, 0.01), error(16, 0.1, 0.04), error(64, 0.05, 0.16)};
      m.curves.push_back(c);
      pictures.pictures.emplace_back(4, 3);
    }
    m.curves[0].power_law = mc::PowerLaw{.slope = -0.5, .lo = -0.52, .hi = -0.48};
    m.curves[0].theory = ConvergenceRate{0.5, 0, "independent samples"};
    pictures.biases = {{{0, 0, 0.01}, 0.05, 64, {}},
                       {{0.3, 0.29, 0.31}, 0.02, 64, IntervalEstimate{0.45, 0.4, mc::infinity<double>}}};
    pictures.reference = render::Image(4, 3);
    pictures.reference_spp = 6400;
    pictures.reference_error = 0.004;
    const TradeCandidate cheap{&m.curves[0], 16, {0.04, 0.035, 0.045}, {0.1, 0.09, 0.11}},
        as_cheap{&m.curves[1], 16, {0.041, 0.036, 0.046}, {0.1, 0.09, 0.11}};
    trade_results.by_error = {{0.1, {cheap, as_cheap}, {}, {}}, {1e-6, {}, {cheap}, {}}};
    trade_results.by_time = {{0.04, {cheap}, IntervalEstimate{3, 2, 4}}, {1e-9, {}, {}}};
    trade_results.pareto_front = {cheap};
  }
  PageEntry measured() const { return {&target, &pictures.measurement, &pictures, &trade_results}; }
};

struct ConvergencePage : support::ScratchTest {
  std::string page(const PageHeader& head, const std::vector<PageEntry>& all) const {
    ResultWriter results;
    write_convergence_page(results, path("."), head, all);
    results.finish();
    return mc::read_file(path("index.html"));
  }
};

TEST_F(ConvergencePage, Scene_HasTheAnswerAndThePictures) {
  const PictureExample e;
  const std::string page = this->page(trade_header("carlo trade 'a <room>.xml' --cost rays"), {e.measured()});
  EXPECT_THAT(page, AllOf(HasSubstr("<title>carlo trade</title>"), HasSubstr("Which method to choose"),
                          HasSubstr("4&times;3 pixels; reference of 6400 samples per pixel with an error of 0.004")));
  EXPECT_THAT(page, HasSubstr("<p class=\"answer\">The cheapest method for an RMS error of 0.1 is mis independent. No "
                              "method reached an RMS error of 1e-06. The most accurate method for 0.04 Mray is mis "
                              "independent; the error of plain Monte Carlo is 3 times as large. 1e-09 Mray is too "
                              "little for any method.</p>"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("</i>mis independent <span class=\"wins\">cheapest</span> <span class=\"wins\">most "
                              "accurate</span>"),
                    HasSubstr("class=\"winner\"")));
  EXPECT_THAT(page, AllOf(HasSubstr("0.04 <small>[0.035, 0.045]</small>"),
                          HasSubstr("<span class=\"ties\">light sobol</span>"),
                          HasSubstr("class=\"none\" colspan=\"4\">not reached; smallest error: <i"),
                          HasSubstr("too little for any method"), HasSubstr("3 <small>[2, 4]</small> &times;")));
  EXPECT_THAT(page, AllOf(HasSubstr("-0.500 <small>[-0.520, -0.480]</small>"), HasSubstr("\"agrees\">yes</td>"),
                          HasSubstr("\"bias [95 %]\">0.3 <small>[0.29, 0.31]</small></td>"),
                          HasSubstr("\"pays above\">0.45 <small>[0.4, never]</small></td>"),
                          HasSubstr("class=\"best\""), HasSubstr("stroke-dasharray")));
  EXPECT_THAT(page, AllOf(HasSubstr("The cost is millions of rays of one picture."), Not(HasSubstr("CPU"))));
  for (const char* file : {"a__room_-reference.png", "a__room_-1.png", "a__room_-2.png"}) {
    EXPECT_THAT(page, HasSubstr(std::string("src=\"") + file + "\""));
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  }
  for (const char* loaded : {"http", "<script", "@import", "url("}) EXPECT_THAT(page, Not(HasSubstr(loaded)));
}

TEST_F(ConvergencePage, Integral_HasNoPicturesAndNoBias) {
  IntegralTarget target;
  target.integral = {"pi", "Area of the disk", "a book", 2, 3.14159, {}, 0, {}};
  const SamplingMethod method = named("random");
  Measurement m;
  ConvergenceCurve c;
  c.method = &method;
  c.errors = {error(64, 0.2, 1e-6), error(65536, 2e-3, 1e-3), error(1 << 20, 5e-4, 2e-2)};
  m.curves = {c};
  m.truth = 3.14159;
  const std::string page = this->page(converge_header("carlo converge pi"), {{&target, &m}});
  EXPECT_THAT(page, AllOf(HasSubstr("a book; 2 dimensions; truth 3.14159"), HasSubstr("<th>method</th>"),
                          HasSubstr("The cost is CPU seconds of one estimate."), Not(HasSubstr("bias")),
                          Not(HasSubstr("<figure")), Not(HasSubstr("class=\"best\""))));
  EXPECT_THAT(page, HasSubstr("10<tspan dy=\"-5\" font-size=\"8\">-6</tspan>"));
  m.curves[0].exact = true; // nothing to draw
  EXPECT_THAT(this->page(converge_header("carlo converge pi"), {{&target, &m}}),
              AllOf(Not(HasSubstr("<svg")), HasSubstr("\"slope [95 %]\">exact</td>")));
}

// An axis that spans a decade or two has ticks at 1, 2 and 5.
TEST_F(ConvergencePage, ShortAxesHaveTicksWithinADecade) {
  const PictureExample e;
  const std::string page = this->page(converge_header("carlo converge a.xml"), {e.measured()});
  for (const char* tick : {">0.05</text>", ">0.1</text>", ">0.2</text>", ">5</text>", ">10</text>", ">50</text>"})
    EXPECT_THAT(page, HasSubstr(tick));
}

TEST_F(ConvergencePage, FitsAPhone) {
  const PictureExample e;
  page(trade_header(std::string(200, 'x')), {e.measured()});
  support::expect_fits_a_phone(path("index.html"));
}

} // namespace
