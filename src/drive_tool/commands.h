#pragma once

#include "options.h"

namespace interpolated_motion::drive_tool {

/// How the program ends.
enum ExitCode { Done = 0, Trouble = 1, BadInput = 2, EndedByUser = 130 };

/// The commands. Each says what it finds, and throws std::exception with a sentence for what it cannot do.
ExitCode scan(const Options& options);
ExitCode read(const Options& options);
ExitCode write(const Options& options);
ExitCode save(const Options& options);
ExitCode dump(const Options& options);
ExitCode diff(const Options& options);
ExitCode restore(const Options& options);
ExitCode monitor(const Options& options);

}  // namespace interpolated_motion::drive_tool
