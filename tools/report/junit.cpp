/// JUnit reports. Only this file of tools includes pugixml.

#include <report/validate_output.h>

#include <mc/core/text.h>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <sstream>

namespace carlo {

namespace {

// Replaces bytes that XML cannot represent, such as control characters and bytes that are not UTF-8. Keeps line ends.
std::string printable(std::string_view text) {
  std::string lines;
  for (bool more = true; more;) {
    const std::size_t end = text.find('\n');
    lines += mc::printable(text.substr(0, end), text.size());
    more = end != text.npos;
    if (more) lines += '\n';
    if (more) text.remove_prefix(end + 1);
  }
  return lines;
}

pugi::xml_node add_node(pugi::xml_node suite, const Case& one) {
  pugi::xml_node node = suite.append_child("testcase");
  node.append_attribute("classname") = printable(one.name).c_str();
  node.append_attribute("name") = printable(one.title()).c_str();
  return node;
}

void add_case(pugi::xml_node suite, const Case& one, const mc::Report& r, const std::string& again) {
  pugi::xml_node node = add_node(suite, one);
  node.append_attribute("time") = fmt::format("{:.3f}", r.seconds).c_str();
  pugi::xml_node properties = node.append_child("properties");
  const auto property = [&](const char* key, const auto& value) {
    pugi::xml_node p = properties.append_child("property");
    p.append_attribute("name") = key;
    p.append_attribute("value") = printable(fmt::format("{}", value)).c_str();
  };
  property("parameters", one.parameters);
  property("scalar", one.scalar);
  property("verdict", name(r.verdict()));
  property("p", r.p());
  property("alpha", r.alpha);
  property("samples", r.samples);
  property("mass", r.mass);
  property("mass_error", r.mass_error);
  property("detectable", r.detectable);
  property("detectable_cell", r.detectable_cell);
  property("ns_per_sample", r.ns_per_sample);
  property("fault", name(r.fault()));
  property("again", again);
  if (r.passed()) return;
  pugi::xml_node failure = node.append_child("failure");
  failure.append_attribute("message") = printable(r.verdict_text()).c_str();
  failure.append_attribute("type") = std::string(name(r.fault())).c_str();
  failure.text() = printable(r.to_string(mc::ReportText::full)).c_str();
}

} // namespace

std::string validation_junit(const ValidationRun& run) {
  const auto& [settings, cases, reports, interrupted, unchecked] = run;
  std::size_t failures = 0;
  double seconds = 0;
  for (const mc::Report& r : reports) {
    failures += !r.passed();
    seconds += r.seconds;
  }
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node suite = document.append_child("testsuite");
  suite.append_attribute("name") = "carlo validate";
  suite.append_attribute("tests") = static_cast<unsigned>(cases.size() + unchecked.size());
  suite.append_attribute("failures") = static_cast<unsigned>(failures);
  suite.append_attribute("errors") = static_cast<unsigned>(unchecked.size());
  suite.append_attribute("time") = fmt::format("{:.3f}", seconds).c_str();
  for (std::size_t i = 0; i < cases.size(); ++i)
    add_case(suite, *cases[i], reports[i], repeat_command(*cases[i], settings, cases.size() + unchecked.size()));
  for (const UncheckedCase& u : unchecked)
    add_node(suite, *u.test_case).append_child("error").append_attribute("message") = printable(u.error).c_str();
  if (interrupted) suite.append_child("system-err").text() = "interrupted: only the finished cases are listed";
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

} // namespace carlo
