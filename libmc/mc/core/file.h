#pragma once
/// Files that appear whole or not at all.

#include <functional>
#include <string>
#include <string_view>

namespace mc {

/// Runs write(temporary) on a temporary name beside `path`, then renames it to `path`: an interrupted run leaves the
/// old file or the new one, never half of one. The temporary file keeps the extension of `path` and is removed when
/// write throws.
///   throws : Error when the folder is missing or not writable, or `path` is a folder
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// Writes the bytes by replace_file. Throws Error when the disk is full.
void write_file(const std::string& path, std::string_view bytes);

/// Refuses a place that replace_file would refuse, before the work for it is done. Changes nothing.
void require_writable(const std::string& path);

/// The whole file. Throws Error when it is missing or cannot be read.
std::string read_file(const std::string& path);

} // namespace mc
