#include "simulation/recording_command.h"

#include <optional>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/input_file.h"
#include "interpolated_motion_driver/recording/recording_file.h"
#include "interpolated_motion_driver/recording/yaml_text.h"
#include "simulation/recording_replay.h"

namespace interpolated_motion::simulation {

namespace {

void tell_fault(const char* whose, const std::optional<recording::RecordedFault>& fault) {
  if (fault) {
    fmt::print("{}: fault at {} s: {}\n", whose, recording::time_text(fault->time), fault->text);
  } else {
    fmt::print("{}: no fault\n", whose);
  }
}

}  // namespace

int replay_recording(const std::string& name) {
  const auto file = recording::parse_recording(command_line::read_text_file(name));
  fmt::print("recorded: {}; {} orders, {}\n", file.cause, file.orders.size(),
             file.complete ? "from the driver's start on" : "from the first order on that was in force");
  const Replayed outcome = replay(file, [](HostTime time, const std::string& line) {
    fmt::print("{}  {}\n", recording::time_text(time), line);
  });
  tell_fault("recorded", outcome.recorded);
  tell_fault("replayed", outcome.replayed);
  if (outcome.recorded && outcome.replayed)
    fmt::print("apart by {:.6f} s\n", seconds(outcome.replayed->time - outcome.recorded->time));
  const bool is_same = outcome.is_same();
  fmt::print("{}; {} of {} orders were answered otherwise\n", is_same ? "the same" : "NOT the same",
             outcome.answered_otherwise, outcome.orders);
  return is_same ? 0 : 1;
}

}  // namespace interpolated_motion::simulation
