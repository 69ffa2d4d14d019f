#pragma once
/// Reading files, and writing files atomically.

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace mc {

/// Calls write(stream) with a stream that can seek, then moves its content to `path`. Follows symbolic links.
///   regular file, or no file yet : The stream is a new file in the same folder, under a random name. It is synced and
///   renamed over `path`, and the folder is synced. An interrupted run or a crash of the system leaves the old file or
///   the new file, never a partial file. Permissions are kept. A killed process may leave the file ".mc-*.tmp".
///   device, named pipe or descriptor of this process (/dev/stdout) : It is kept, and the bytes are written to it.
///   throws    : Error if the folder is missing or not writable, if `path` is a folder or a socket, or if the disk is
///               full. If this function or `write` throws, the old content remains and no other file is left. Errors
///               of `write` get the prefix "cannot write 'path': ".
void replace_file(const std::string& path, const std::function<void(std::FILE*)>& write);

/// Writes all bytes to a stream of replace_file(). Throws Error with the reason of the system.
void write_bytes(std::FILE* stream, std::string_view bytes);

/// Writes `bytes` to `path` with replace_file().
void write_file(const std::string& path, std::string_view bytes);

/// Throws the errors that replace_file() can detect before writing: makes and removes an empty file in the folder.
void require_writable(const std::string& path);

/// Creates the folder `name` and its missing parents, and returns its path.
///   throws  : Error if the folder cannot be created, or if `first_file` could not be written in it.
std::filesystem::path make_output_folder(const std::string& name, const std::string& first_file);

/// Whether two paths name the same file, by device and inode; hard links are the same file. For files that do not
/// exist: whether creating one creates the other.
bool is_same_path(const std::string& a, const std::string& b);

/// Extension of the file name in lower case, with its dot: ".exr" for "a/b.EXR". Returns "" if there is none.
std::string lowercase_extension(const std::string& path);

/// Returns the content of a file or of a pipe. Waits 5 s for the writer of a named pipe.
///   throws : Error if `path` is missing, a folder or a device, cannot be read, or is larger than allowed_memory().
std::string read_file(const std::string& path);

/// Same as read_file(), without the byte order mark that some programs write at the start of UTF-8 text.
std::string read_text(const std::string& path);

} // namespace mc
