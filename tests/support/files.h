#pragma once
// Scratch folders and error messages, for tests of input and output.

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <unistd.h>

namespace support {

/// A test with its own folder, which is removed at the end.
struct ScratchTest : testing::Test {
  std::filesystem::path folder;

  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::path(testing::TempDir()) /
             (std::string(info->test_suite_name()) + "." + info->name() + "." + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::remove(folder / name); // some file systems flush to disk when a file is truncated
    std::ofstream(folder / name, std::ios::binary) << text;
    return path(name);
  }
};

/// Error message of f; "" if it does not throw.
inline std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const mc::Error& e) {
    return e.what();
  }
  return "";
}

} // namespace support
