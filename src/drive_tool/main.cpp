#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.h"
#include "kernel_waiter.h"
#include "options.h"
#include "terminal.h"

namespace interpolated_motion::drive_tool {
namespace {

struct Action {
  const char* command;
  ExitCode (*run)(const Options& options);
};

constexpr Action kActions[] = {{"scan", scan}, {"read", read}, {"write", write},     {"save", save},
                               {"dump", dump}, {"diff", diff}, {"restore", restore}, {"monitor", monitor}};

ExitCode run(const Options& options) {
  for (const Action& action : kActions)
    if (options.command == action.command) return action.run(options);
  return BadInput;
}

}  // namespace
}  // namespace interpolated_motion::drive_tool

int main(int argc, char** argv) {
  using namespace interpolated_motion::drive_tool;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    const auto options = parse_options(arguments);
    if (options) return run(*options);
    std::fputs(usage(arguments.front()).c_str(), stdout);
    return Done;
  } catch (const Interrupted&) {
    return EndedByUser;
  } catch (const std::invalid_argument& error) {
    complain(error.what());
    return BadInput;
  } catch (const std::exception& error) {
    complain(error.what());
    return Trouble;
  }
}
