#pragma once

#include <cstddef>
#include <string>

namespace interpolated_motion::drive_tool {

/// Prints a line at once.
void say(const std::string& text);
/// The same to the standard error, with the program's name before it.
void complain(const std::string& text);

/// Puts a question on the terminal. True for "y" and "yes"; false for all else, and where no answer comes.
bool ask(const std::string& question);
/// Shows a text in place of the last one, on a terminal; else below it.
void show_page(const std::string& text);

/// Shows on one line of the terminal how far something is; nothing where the standard error is no terminal.
class ProgressLine {
 public:
  /// `what` stands before the figures: "asked".
  explicit ProgressLine(std::string what) : what_(std::move(what)) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::size_t done, std::size_t all);
  /// Takes the line away.
  void clear();

 private:
  std::string what_;
  bool shown_ = false;
};

}  // namespace interpolated_motion::drive_tool
