#include "simulation/fail_each.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "simulation/failing_allocation.h"

namespace interpolated_motion::simulation {

namespace {

constexpr const char* kLimits = "limits: {max_acceleration: 20}";

std::string can_joint(const std::string& type, int number) {
  return fmt::format(
      "joint{}: {{bus: can0, type: {}, node_id: {}, counts_per_revolution: 2000, gear_ratio: 100, {}}}",
      number, type, number, kLimits);
}

std::string serial_joint(int number) {
  return fmt::format(
      "joint{}: {{bus: line0, type: silverlode_ims, address: {}, counts_per_revolution: 4000, gear_ratio: "
      "50, "
      "{}}}",
      number, number, kLimits);
}

std::string arm_of(const std::string& kind) {
  const std::string can = "can0: {type: canopen}";
  const std::string line = "line0: {type: silverlode}";
  const auto arm = [](const std::string& buses, const std::string& first, const std::string& second) {
    return fmt::format("{{joints: [joint1, joint2], buses: {{{}}}, drives: {{{}, {}}}}}", buses, first,
                       second);
  };
  if (kind == "epos") return arm(can, can_joint("epos_ipm", 1), can_joint("epos_ipm", 2));
  if (kind == "cyclic") return arm(can, can_joint("cyclic", 1), can_joint("cyclic", 2));
  if (kind == "silverlode") return arm(line, serial_joint(1), serial_joint(2));
  if (kind == "mixed") return arm(can + ", " + line, can_joint("epos_ipm", 1), serial_joint(2));
  throw std::invalid_argument(fmt::format("there is no whole run of kind \"{}\"; known: {}", kind,
                                          fmt::join(fail_each_kinds(), ", ")));
}

/// A goal, one that is stopped in motion, and the end. All drives are up within a second, also when a frame
/// of bring-up is lost and asked for again.
constexpr const char* kEvents =
    "at_once\n"
    "at 1.5 goal points=3 shape=1 effort=0.5 reach=0.5 noise=4\n"
    "at 3.5 goal points=4 shape=2 effort=0.2 reach=1 noise=5\n"
    "at 4.2 stop\n"
    "at 5 disable\n";

/// The driver may not even come into being: then nothing moves.
Outcome run_until_out_of_memory(const Script& run) {
  try {
    return Simulation(run).run();
  } catch (const std::bad_alloc&) {
    Outcome outcome;
    outcome.out_of_memory = true;
    return outcome;
  }
}

bool is_can(const std::string& bus) { return bus.compare(0, 3, "can") == 0; }

}  // namespace

const std::vector<std::string>& fail_each_kinds() {
  static const std::vector<std::string> kinds{"epos", "cyclic", "silverlode", "mixed"};
  return kinds;
}

Script whole_run(const std::string& kind) {
  return parse_script(fmt::format("configuration {}\n{}", arm_of(kind), kEvents));
}

std::vector<Failure> failures_of(const Script& run) {
  const Outcome outcome = simulate(run);
  std::vector<Failure> failures;
  for (const auto& [bus, sent] : outcome.sent) {
    const std::uint64_t received = outcome.received.at(bus);
    if (is_can(bus)) {
      failures.push_back({bus, "drop_nth", sent + received});
    } else {
      failures.push_back({bus, "lose_request", sent});
      failures.push_back({bus, "lose_reply", received});
    }
    failures.push_back({bus, "refuse_nth", sent});
  }
  return failures;
}

Script with_failure(const Script& run, const Failure& failure, std::uint64_t n) {
  Script script = run;
  Event event;
  event.verb = "inject";
  event.target = failure.bus;
  event.command = fmt::format("{} {}", failure.command, n);
  script.events.insert(script.events.begin(), event);
  return script;
}

FailEachTally fail_each(const Script& run, const Failure& failure, std::uint64_t first, std::uint64_t stride,
                        const std::function<void(std::uint64_t n, const Script&, const Outcome&)>& tell) {
  const std::size_t succeed = simulate(run).goals_succeeded;
  FailEachTally tally;
  for (std::uint64_t n = first; n <= failure.count; n += stride) {
    const Script script = with_failure(run, failure, n);
    const Outcome outcome = simulate(script);
    ++tally.runs;
    ++(outcome.violation                    ? tally.violated
       : outcome.goals_succeeded == succeed ? tally.unnoticed
                                            : tally.told);
    tell(n, script, outcome);
  }
  return tally;
}

FailEachTally fail_each_allocation(const Script& run, std::uint64_t first, std::uint64_t stride,
                                   const std::function<void(std::uint64_t n, const Outcome&)>& tell) {
  const std::uint64_t before = allocations();
  const std::size_t succeed = run_until_out_of_memory(run).goals_succeeded;
  const std::uint64_t most = allocations() - before;
  FailEachTally tally;
  for (std::uint64_t n = first; n <= most; n += stride) {
    const std::int64_t held = allocations_held();
    bool failed = false;
    Outcome outcome;
    {
      const FailingAllocation failing(n);
      outcome = run_until_out_of_memory(run);
      failed = failing.has_failed();
    }
    outcome.sent.clear();
    outcome.received.clear();
    outcome.known.clear();
    if (!outcome.violation && allocations_held() != held)
      outcome.violation = {"no leak", outcome.seconds,
                           fmt::format("{} allocations are not freed", allocations_held() - held)};
    if (!failed) continue;
    ++tally.runs;
    // std::stable_sort does without the memory that it does not get.
    const bool unnoticed = !outcome.out_of_memory && outcome.goals_succeeded == succeed;
    if (!outcome.out_of_memory && !unnoticed && !outcome.violation)
      outcome.violation = {"no exception", outcome.seconds, "an allocation has failed, and nobody has told"};
    ++(outcome.violation ? tally.violated : unnoticed ? tally.unnoticed : tally.told);
    tell(n, outcome);
  }
  return tally;
}

}  // namespace interpolated_motion::simulation
