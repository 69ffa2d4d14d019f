#include <options/files.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <filesystem>
#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

Option input_file(Option o) {
  o.use = FileUse::input;
  return o;
}

Option output_file(Option o) {
  o.use = FileUse::output;
  return o;
}

Option state_file(Option o) {
  o.use = FileUse::state;
  return o;
}

Option output_folder(Option o, std::vector<std::string> files) {
  o.use = FileUse::output_folder;
  o.files = std::move(files);
  return o;
}

namespace {

std::vector<std::string> values_of(const Option& o) {
  if (const auto* one = std::get_if<std::string*>(&o.destination)) return {**one};
  if (const auto* several = std::get_if<std::vector<std::string>*>(&o.destination)) return **several;
  return {};
}

// Whether a write replaces the file.
bool is_replaced(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !fs::exists(status) || fs::is_regular_file(status);
}

bool is_same_output(const std::string& a, const std::string& b) {
  return a == "-" || b == "-" ? a == b : is_replaced(a) && mc::is_same_path(a, b);
}

} // namespace

std::vector<UsedFile> files_of(const std::vector<Option>& options) {
  std::vector<UsedFile> all;
  for (const Option& o : options)
    for (const std::string& value : values_of(o)) {
      if (value.empty() || o.use == FileUse::none) continue;
      const std::string name = o.names.substr(o.names.find(',') + 1);
      const std::string what = name.starts_with('-') ? "the file of " + name : name;
      if (o.use == FileUse::input) all.push_back({value, what});
      if (o.use == FileUse::output) all.push_back({value, name, true});
      if (o.use == FileUse::state) all.push_back({value, name, true, true});
      for (const std::string& file : o.files) all.push_back({(fs::path(value) / file).string(), name, true});
    }
  return all;
}

void require_distinct_files(const std::vector<UsedFile>& files) {
  std::error_code error;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = i + 1; j < files.size(); ++j) {
      const UsedFile &a = files[i], &b = files[j];
      if (a.is_state && b.is_state) continue;
      mc::require(!a.is_output || !b.is_output || !is_same_output(a.path, b.path),
                  "{} and {} would both write '{}'; name another file", a.origin, b.origin, a.path);
      if (a.is_output == b.is_output) continue;
      const UsedFile &in = a.is_output ? b : a, &out = a.is_output ? a : b;
      mc::require(out.path == "-" || !fs::is_regular_file(in.path, error) || !mc::is_same_path(in.path, out.path),
                  "{} would write '{}' over {}; name another file", out.origin, out.path, in.origin);
    }
}

} // namespace carlo
