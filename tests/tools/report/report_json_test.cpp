// Reports to JSON and back, and to JUnit.

#include <report/report_json.h>
#include <report/validate_output.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace {

using testing::AllOf;
using testing::HasSubstr;

// A report with every field set, with values that are hard to encode.
mc::Report full() {
  mc::Report r;
  r.subject = "<\"A&B\">";
  r.alpha = 0.1;
  r.samples = (std::uint64_t{1} << 60) + 1;
  r.mass = 1 / 3.0;
  r.mass_error = std::numeric_limits<double>::denorm_min();
  r.detectable = HUGE_VAL;
  r.detectable_cell = -0.0;
  r.seconds = 1e3;
  r.ns_per_sample = 2;
  r.checks = {{"mass", mc::Verdict::fail, {}, 0, NAN, 1, mc::Fault::mass, "too much < 1 & more\x01"},
              {"bins", mc::Verdict::inconclusive, 0.25, 0.5, 7, 0, mc::Fault::shape, ""}};
  r.axes = {{"radius", mc::Axis::Scale::radius, 1, 2}};
  r.worst = {{{0, .5, 0}, {1, .75, 0}, 3, 4, -0.5, "(1, 2)"}};
  r.figures = {{"albedo", 0.5, 0.01, "45 deg"}};
  r.evidence = mc::PlotData{{{{0, 0, 0}, {1, 1, 1}, 5, 6}}, {{{}, {}, 7, 8}}, {{1024, 0.125}}};
  return r;
}

// The text distinguishes all doubles, including NaN and -0.
std::string as_text(const mc::Report& r) { return carlo::to_json(r).dump(-1, ' ', false); }

TEST(ReportJson, CborRoundTripIsExact) {
  const mc::Report r = full();
  const auto bytes = nlohmann::json::to_cbor(carlo::to_json(r));
  const mc::Report back = carlo::report_from_json(nlohmann::json::from_cbor(bytes));
  EXPECT_EQ(as_text(back), as_text(r));
  EXPECT_EQ(nlohmann::json::to_cbor(carlo::to_json(back)), bytes);
  EXPECT_EQ(back.samples, r.samples);
  EXPECT_TRUE(std::isnan(back.checks[0].statistic));
  EXPECT_TRUE(std::signbit(back.detectable_cell));
  EXPECT_EQ(back.detectable, HUGE_VAL);
  EXPECT_FALSE(back.checks[0].p.has_value());
  EXPECT_EQ(back.checks[1].fault, mc::Fault::shape);
  EXPECT_EQ(back.to_string(), r.to_string());
}

TEST(ReportJson, OmitsMissingEvidence) {
  mc::Report r = full();
  r.evidence.reset();
  EXPECT_FALSE(carlo::report_from_json(carlo::to_json(r)).evidence.has_value());
}

TEST(ReportJson, DamagedJson_Throws) {
  nlohmann::json j = carlo::to_json(full());
  j["checks"][0]["fault"] = "nonsense";
  EXPECT_THAT(support::error_of([&] { carlo::report_from_json(j); }),
              HasSubstr("'nonsense' is not a verdict, fault or axis scale"));
  j = carlo::to_json(full());
  j.erase("checks");
  EXPECT_THAT(support::error_of([&] { carlo::report_from_json(j); }), HasSubstr("the report is damaged"));
}

TEST(ReportJson, TextIsValidJson) {
  EXPECT_EQ(carlo::json_text(nlohmann::json{{"a", "\xff"}, {"b", NAN}}),
            "{\n \"a\": \"\xef\xbf\xbd\",\n \"b\": null\n}\n");
}

TEST(JunitTest, IsEscaped) {
  const carlo::Case one{"<\"A&B\">", "x<1", "double", {}};
  const std::vector<const carlo::Case*> cases{&one};
  const std::vector<mc::Report> reports{full()};
  const std::string xml = carlo::validation_junit({{}, cases, reports});
  EXPECT_THAT(xml, AllOf(HasSubstr("classname=\"&lt;&quot;A&amp;B&quot;>\""), HasSubstr("too much &lt; 1 &amp; more?"),
                         HasSubstr("tests=\"1\" failures=\"1\"")));
  EXPECT_EQ(xml.find('\x01'), std::string::npos);
}

} // namespace
