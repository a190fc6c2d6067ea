#pragma once

#include <string>

namespace interpolated_motion::command_line {

/// Numbered files of one kind in a folder, `PREFIX000001.txt` and so on. None is ever written over, and no
/// more than `keep` are there: the oldest are removed when another one is written.
class FileSeries {
 public:
  /// `keep`: at least 1. The folder is made when the first file is written.
  FileSeries(std::string folder, std::string prefix, int keep);

  /// Writes a new file and returns its absolute path. Throws std::runtime_error with the path and what
  /// failed; then there is no new file.
  std::string write(const std::string& text) const;

 private:
  std::string folder_;
  std::string prefix_;
  int keep_;
};

}  // namespace interpolated_motion::command_line
