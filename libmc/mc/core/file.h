#pragma once
/// Reading files, and writing files atomically.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace mc {

/// Calls write(temporary) with the name of a temporary file, then moves its content to `path`. Follows symbolic links.
///   regular file, or no file yet : The temporary file lies in the same folder and is renamed over `path`. An
///   interrupted run leaves the old file or the new file, never a partial file. Permissions are kept.
///   device, named pipe or descriptor of this process (/dev/stdout) : It is kept, and the bytes are written to it.
///   temporary : has the extension of `path`.
///   throws    : Error if the folder is missing or not writable, if `path` is a folder or a socket, or if the disk is
///               full. If this function or `write` throws, the old content remains and no other file is left.
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// Writes `bytes` to `path` with replace_file().
void write_file(const std::string& path, std::string_view bytes);

/// Throws the errors that replace_file() can detect before writing. Changes nothing on disk.
void require_writable(const std::string& path);

/// Creates the folder `name` and its missing parents, and returns its path.
///   throws  : Error if the folder cannot be created, or if `first_file` could not be written in it.
std::filesystem::path make_output_folder(const std::string& name, const std::string& first_file);

/// Whether two paths name the same file system location. The file need not exist.
bool is_same_path(const std::string& a, const std::string& b);

/// Extension of the file name in lower case, with its dot: ".exr" for "a/b.EXR". Returns "" if there is none.
std::string lowercase_extension(const std::string& path);

/// Returns the content of a file or of a pipe. Throws Error if `path` is missing, a folder or a device, or cannot be
/// read.
std::string read_file(const std::string& path);

/// Same as read_file(), without the byte order mark that some programs write at the start of UTF-8 text.
std::string read_text(const std::string& path);

} // namespace mc
