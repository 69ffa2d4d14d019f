#pragma once
// Small scene files for tests of the reader.

#include <render/io/mitsuba/mitsuba.h>

#include "support/files.h"

namespace support {

struct SceneTest : ScratchTest {
  static constexpr const char* sensor = "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>";

  std::string scene(const std::string& body) const {
    return write("s.xml", "<scene version=\"0.6.0\">\n" + body + "\n</scene>\n");
  }
  /// The error message for a scene, which must be one line.
  std::string refusal(const std::string& body, render::Dialect dialect = render::Dialect::mitsuba) const {
    const std::string file = scene(body);
    const std::string message = error_of([&] { render::read_mitsuba(file, dialect); });
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line: " << message;
    return message;
  }
};

} // namespace support
