#include <cstdio>
#include <exception>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpolated_motion_driver/command_line/file_series.h"
#include "interpolated_motion_driver/command_line/input_file.h"
#include "simulation/fail_each_command.h"
#include "simulation/options.h"
#include "simulation/recording_command.h"
#include "simulation/script_generator.h"
#include "simulation/shrinker.h"
#include "simulation/simulation.h"

namespace interpolated_motion::simulation {

namespace {

struct Tally {
  std::uint64_t passed = 0;
  std::uint64_t known = 0;
  std::uint64_t failed = 0;
};

/// The smallest script that has the violation or the known fault `name`.
Script smallest(const Script& script, const std::string& name) {
  return shrunk(script, [&name](const Script& candidate) {
    const Outcome outcome = simulate(candidate);
    return outcome.known.count(name) > 0 || (outcome.violation && outcome.violation->invariant == name);
  });
}

/// Known faults are told by name, each with a script once if that is wanted.
void tell_known(std::uint64_t seed, const Script& script, const Outcome& outcome, const Options& options) {
  static std::set<std::string> told;
  for (const auto& [name, violation] : outcome.known) {
    fmt::print("seed {} known: {}\n", seed, name);
    if (!options.tell_known || !told.insert(name).second) continue;
    fmt::print("# {}: at {:.3f} s: {}\n{}\n", violation.invariant, violation.time, violation.sentence,
               to_text(smallest(script, name)));
  }
}

constexpr int kRecordingsKept = 20;

void write_recording(std::uint64_t seed, const std::string& recording, const std::string& folder) {
  if (folder.empty() || recording.empty()) return;
  const command_line::FileSeries files(folder, "simulation_", kRecordingsKept);
  fmt::print("# recording of seed {}: {}\n", seed, files.write(recording));
}

void tell_failure(std::uint64_t seed, const Script& script, const Violation& violation,
                  const Options& options) {
  const bool shrink = options.shrink;
  fmt::print("seed {} FAILED: {}: at {:.3f} s: {}\n", seed, violation.invariant, violation.time,
             violation.sentence);
  const Script least = shrink ? smallest(script, violation.invariant) : script;
  std::string recording;
  const Outcome again = simulate_recorded(least, recording);
  if (shrink && again.violation)
    fmt::print("# {} of {} events are enough: at {:.3f} s: {}\n", least.events.size(), script.events.size(),
               again.violation->time, again.violation->sentence);
  write_recording(seed, recording, options.recordings);
  fmt::print("{}\n", to_text(least));
}

void run_seed(std::uint64_t seed, const Options& options, Tally& tally) {
  if (options.each) fmt::print("@run {}\n", seed);
  std::fflush(stdout);
  const Script script = random_script(seed, options.kind);
  const Outcome outcome = simulate(script);
  if (options.each)
    fmt::print("@done {} {} {} {} {} {:016x}\n", seed, outcome.seconds, outcome.goals_accepted,
               outcome.goals_refused, outcome.goals_succeeded, outcome.trace);
  tell_known(seed, script, outcome, options);
  if (outcome.violation) {
    ++tally.failed;
    tell_failure(seed, script, *outcome.violation, options);
  } else if (outcome.known.empty()) {
    ++tally.passed;
  } else {
    ++tally.known;
  }
  std::fflush(stdout);
}

int run_seeds(const Options& options) {
  Tally tally;
  for (std::uint64_t i = 0; i < options.seeds; ++i) run_seed(options.start + i, options, tally);
  fmt::print("{} passed, {} failed, {} known\n", tally.passed, tally.failed, tally.known);
  return tally.failed == 0 ? 0 : 1;
}

int replay_script(const Options& options) {
  const Script script = options.script_file.empty()
                            ? random_script(options.start, options.kind)
                            : parse_script(command_line::read_text_file(options.script_file));
  fmt::print("{}\n", to_text(script));
  const Outcome outcome =
      simulate(script, [](double time, const std::string& line) { fmt::print("{:9.3f}  {}\n", time, line); });
  if (outcome.violation)
    fmt::print("FAILED: {}: at {:.3f} s: {}\n", outcome.violation->invariant, outcome.violation->time,
               outcome.violation->sentence);
  fmt::print("{:.2f} s, trace {:016x}, {}\n", outcome.seconds, outcome.trace,
             outcome.violation ? "0 passed, 1 failed" : "1 passed, 0 failed");
  return outcome.violation ? 1 : 0;
}

int run(const std::vector<std::string>& arguments) {
  const Options options = parse_options(arguments);
  if (options.help) {
    fmt::print("{}", usage());
    return 0;
  }
  if (!options.recording_file.empty()) return replay_recording(options.recording_file);
  if (!options.fail_each.empty()) return run_fail_each(options);
  return options.replay ? replay_script(options) : run_seeds(options);
}

}  // namespace

}  // namespace interpolated_motion::simulation

int main(int argc, char** argv) {
  try {
    return interpolated_motion::simulation::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "simulate: {}\n", error.what());
    return 2;
  }
}
