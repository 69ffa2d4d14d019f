/// carlo view: a page on which pictures, or the results of carlo validate, are looked at.

#include <options/memory_option.h>
#include <options/pixels.h>
#include <options/subcommand.h>
#include <picture/crop.h>
#include <picture/difference.h>
#include <report/validate_page.h>
#include <report/view_page.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace carlo {

namespace {

struct ViewCommandOptions {
  std::string command, first, second, output = "view.html", crop;
  double exposure = 0;          ///< [stops]
  std::optional<double> memory; ///< [GiB]
};

std::vector<Option> rows(ViewCommandOptions& o) {
  return in_groups({
      {common_options,
       {
           input_file({"FILE", "FILE", &o.first,
                       "Picture: .exr, .pfm, .hdr, .png or .jpg; or a .json of carlo validate --json.", true}),
           input_file({"SECOND", "FILE", &o.second, "Picture of the same size, to compare with the first."}),
           output_file({"-o,--output", "FILE", &o.output, "Page to write."}),
           {"--crop", "X,Y,W,H", &o.crop, "Show only this part [pixels], from the upper left."},
           {"--exposure", "STOPS", &o.exposure, "Exposure at the start: values are multiplied by 2^STOPS."},
       }},
      {expert_options, {memory_option(o.memory)}},
  });
}

// The results of carlo validate --json as its page, without the maps that only --report has.
std::string results_page(const std::string& file) {
  const nlohmann::json results = nlohmann::json::parse(mc::read_file(file), nullptr, false);
  mc::require(!results.is_discarded(), "'{}' is no JSON", file);
  const bool is_validation = results.is_object() && results.contains("cases") && results["cases"].is_array() &&
                             results.contains("alpha") && results.contains("command");
  mc::require(is_validation, "'{}' has no results of carlo validate --json; other results have no page here", file);
  return fill_page_template(results.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string pictures_page(const ViewCommandOptions& o) {
  std::vector<std::string> files = {o.first};
  if (!o.second.empty()) files.push_back(o.second);
  std::vector<render::Image> images;
  images.reserve(files.size());
  for (const std::string& file : files) images.push_back(render::read_image(file));
  ViewPage page{.tool = "carlo view", .title = {}, .command = o.command, .pictures = {}, .exposure = o.exposure};
  for (render::Image& image : images)
    if (!o.crop.empty()) {
      const render::Crop part = parse_crop(o.crop);
      crop_picture(image, part, files[static_cast<std::size_t>(&image - images.data())]);
      page.x = part.x;
      page.y = part.y;
    }
  for (std::size_t i = 0; i < files.size(); ++i) {
    require_viewable(files[i], images[i], "choose a part by --crop");
    const std::string name = std::filesystem::path(files[i]).filename().string();
    const bool is_twice = files.size() > 1 && name == std::filesystem::path(files[1 - i]).filename();
    page.pictures.emplace_back(is_twice ? files[i] : name, &images[i]);
    page.title += (i > 0 ? " and " : "") + page.pictures[i].first;
  }
  return to_html(page);
}

int run_view(const ViewCommandOptions& o) {
  limit_memory(o.memory);
  mc::require(std::abs(o.exposure) <= 10, "--exposure {} must lie in [-10, 10] stops", o.exposure);
  mc::require_writable(o.output);
  const bool is_json = std::filesystem::path(o.first).extension() == ".json";
  mc::require(!is_json || (o.second.empty() && o.crop.empty()), "'{}': results of validate have no {}", o.first,
              o.crop.empty() ? "second file" : "--crop");
  const std::string page = is_json ? results_page(o.first) : pictures_page(o);
  ResultWriter results;
  results.write(o.output, false, page);
  results.finish();
  fmt::print("{}: open it in a browser\n", o.output);
  return exit_ok;
}

} // namespace

Subcommand view_subcommand() {
  return make_subcommand<ViewCommandOptions>(
      {.name = "view",
       .summary = "Write a page to look at a picture: zoom, exposure, values of pixels with their 95 % intervals",
       .examples = {{"carlo view a.exr", "writes view.html, one file that needs no network"},
                    {"carlo view a.exr b.exr -o ab.html",
                     "flips between two pictures, splits them, and subtracts them"},
                    {"carlo view big.exr --crop 0,0,512,512", "shows a part of a large picture"}}},
      rows, run_view);
}

} // namespace carlo
