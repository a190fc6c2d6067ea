#include "terminal.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include <fmt/format.h>

namespace interpolated_motion::drive_tool {

void say(const std::string& text) {
  std::puts(text.c_str());
  std::fflush(stdout);
}

void complain(const std::string& text) { std::fprintf(stderr, "drive_tool: %s\n", text.c_str()); }

bool ask(const std::string& question) {
  std::fputs((question + " [y/N] ").c_str(), stdout);
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "yes";
}

void show_page(const std::string& text) {
  // ECMA-48: cursor to the top, and what is left of the last page away.
  if (isatty(STDOUT_FILENO) != 0) return say("\033[H\033[J" + text);
  say(text);
}

void ProgressLine::show(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  shown_ = true;
  std::fputs(fmt::format("\r{} {} of {}\033[K", what_, done, all).c_str(), stderr);
}

void ProgressLine::clear() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace interpolated_motion::drive_tool
