#pragma once
// Loads pages in a headless browser, if one is installed.

#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace support {

inline constexpr const char* no_browser = "no chromium here: the page was not looked at in a browser";

/// The DOM after the browser loaded file#hash, and its console messages; empty without a browser.
inline std::string browse(const std::filesystem::path& file, const std::string& hash) {
  for (const char* browser : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system(fmt::format("command -v {} >/dev/null 2>&1", browser).c_str()) != 0) continue;
    const std::string command = fmt::format(
        "timeout 60 {} --headless --no-sandbox --disable-gpu --disable-background-networking --disable-dev-shm-usage "
        "--user-data-dir='{}' --enable-logging=stderr --virtual-time-budget=3000 --dump-dom 'file://{}#{}'",
        browser, (file.parent_path() / "profile").string(), file.string(), hash);
    return run(command).output;
  }
  return {};
}

/// The first message on the browser's console.
inline std::string logged(const std::string& dom) {
  const std::size_t at = dom.find("CONSOLE");
  return at == std::string::npos ? "" : dom.substr(at, 500);
}

/// Checks that nothing in the page file#hash is wider than a phone, and that no table scrolls sideways. The page is
/// loaded in a frame of 390 pixels, since a browser's own window is never so narrow. The page reports its width to the
/// frame, after half a second for scripts that draw later.
inline void expect_fits_a_phone(const std::filesystem::path& file, const std::string& hash = {}) {
  std::string text = mc::read_file(file.string());
  text.insert(text.find("</body>"),
              "<script>setTimeout(() => {"
              "const hidden = [...document.querySelectorAll('.scroll')].map(e => e.scrollWidth - e.clientWidth);"
              "parent.postMessage(document.documentElement.scrollWidth + ' of ' + innerWidth + ', hidden ' + "
              "Math.max(0, ...hidden), '*'); }, 500);</script>");
  mc::write_file((file.parent_path() / "phone.html").string(), text);
  const std::filesystem::path frame = file.parent_path() / "frame.html";
  mc::write_file(frame.string(),
                 "<body><script>addEventListener('message', e => { document.title = 'width ' + e.data; });</script>"
                 "<iframe src='phone.html#" +
                     hash + "' style='width: 390px; height: 844px; border: 0'></iframe></body>");
  const std::string dom = browse(frame, "");
  if (dom.empty()) GTEST_SKIP() << no_browser;
  int wide = 0, of = 0, hidden = 0;
  const std::size_t at = dom.find("<title>width");
  ASSERT_NE(at, std::string::npos) << dom.substr(0, 1000);
  ASSERT_EQ(std::sscanf(dom.c_str() + at, "<title>width %d of %d, hidden %d", &wide, &of, &hidden), 3)
      << dom.substr(at, 100);
  EXPECT_LE(of, 390);
  EXPECT_LE(wide, of);
  EXPECT_EQ(hidden, 0) << "pixels of a table that scrolls sideways";
}

} // namespace support
