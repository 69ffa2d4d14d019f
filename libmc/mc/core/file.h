#pragma once
/// Files that appear whole or not at all, and outputs that are no files.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace mc {

/// Runs write(temporary) on a temporary name with the extension of `path`, then puts what it wrote in the place of
/// `path`. Links are followed.
///   a regular file, or nothing yet : the temporary file stands beside it and is renamed over it, so that an
///             interrupted run leaves the old file or the new one, never half of one. Permissions are kept
///   a device, a named pipe, a descriptor of this process (/dev/stdout) : stays, and the bytes are written through to
///   it
///   throws  : Error when the folder is missing or not writable, `path` is a folder or a socket, or the disk is full.
///             The old content and nothing else is left when it throws, or when write does
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// Writes the bytes as replace_file does.
void write_file(const std::string& path, std::string_view bytes);

/// Refuses a place that replace_file would refuse, before the work for it is done. Changes nothing.
void require_writable(const std::string& path);

/// The folder, made with those above it where it is missing.
///   throws  : Error where it cannot be made, or where `first_file` could not be written in it
std::filesystem::path make_output_folder(const std::string& name, const std::string& first_file);

/// Whether two paths lead to one place, be there a file or not.
bool is_same_path(const std::string& a, const std::string& b);

/// ".exr" of "a/b.EXR": the last dot of the name and what follows, in small letters; "" where there is none.
std::string lowercase_extension(const std::string& path);

/// The whole file, or all that a pipe gives. Throws Error when it is missing, a folder or a device, or cannot be read.
std::string read_file(const std::string& path);

/// The same without the mark of its byte order that some programs put before text in UTF-8.
std::string read_text(const std::string& path);

} // namespace mc
