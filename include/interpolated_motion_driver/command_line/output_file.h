#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace interpolated_motion::command_line {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// Closes itself; never null unless a function says so.
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

/// Whether a file that is there already is one of those that this program writes, by its first line: without
/// the newline, and of a long one the first 255 characters.
using IsOurs = bool (*)(const std::string& first_line);

/// What becomes of a file of ours that is there already.
enum class EarlierFile {
  GoOn,     ///< what is written comes behind what is there, on a line of its own
  Replace,  ///< it is emptied
};

/// Opens a file that a user has named, to write to it, and makes it where there is none. Never waits: only
/// regular files are taken, neither FIFOs nor devices. Never harms what is not ours: a symbolic link is
/// refused, as its target has not been named, and so is a file that is not empty and of which `is_ours` says
/// no. Throws std::runtime_error: the path, why not, and what to do; then nothing has been changed.
OpenFile open_output_file(const std::string& path, EarlierFile earlier, IsOurs is_ours);

/// Makes a new file to write to; null where there is something of that name, be it a link to nowhere. Throws
/// std::runtime_error: the path and why it cannot be made.
OpenFile create_output_file(const std::string& path);

/// Empties a file that has been opened to write, and goes on at its begin. Throws std::runtime_error.
void begin_anew(std::FILE* file, const std::string& path);

}  // namespace interpolated_motion::command_line
