#pragma once
// A headless browser, where there is one, to see what it makes of a page.

#include <tools/run_carlo.h>

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace support {

/// What the browser made of the page at the address file#hash, and what it logged; empty without a browser.
inline std::string browse(const std::filesystem::path& file, const std::string& hash) {
  for (const char* browser : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system(fmt::format("command -v {} >/dev/null 2>&1", browser).c_str()) != 0) continue;
    const std::string command = fmt::format(
        "timeout 60 {} --headless --no-sandbox --disable-gpu --disable-background-networking --disable-dev-shm-usage "
        "--user-data-dir='{}' --enable-logging=stderr --virtual-time-budget=3000 --dump-dom 'file://{}#{}'",
        browser, (file.parent_path() / "profile").string(), file.string(), hash);
    return run(command).output;
  }
  fmt::print("no chromium here: the page was not looked at in a browser\n");
  return {};
}

/// What the page complained of on the browser's console.
inline std::string logged(const std::string& dom) {
  const std::size_t at = dom.find("CONSOLE");
  return at == std::string::npos ? "" : dom.substr(at, 500);
}

} // namespace support
