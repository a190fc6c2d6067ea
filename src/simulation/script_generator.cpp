#include "simulation/script_generator.h"

#include <algorithm>

#include "simulation/arm.h"
#include "simulation/arm_generator.h"
#include "simulation/fault_generator.h"
#include "simulation/random.h"

namespace interpolated_motion::simulation {

namespace {

Event event_at(double time, const char* verb) {
  Event event;
  event.time = time;
  event.verb = verb;
  return event;
}

/// 0: none; the others spoil a goal, see goal_maker.h.
int random_defect(Random& random) { return random.chance(0.06) ? random.whole(1, 5) : 0; }

void set_if(Event& event, const char* name, double value) {
  if (value != 0.0) event.numbers[name] = value;
}

Event random_goal(Random& random, const Arm& arm, double time) {
  Event goal = event_at(time, "goal");
  goal.numbers["points"] = random.chance(0.5) ? random.whole(1, 3) : random.whole(4, 30);
  goal.numbers["shape"] = random.whole(0, 3);
  goal.numbers["effort"] = random.chance(0.8) ? random.thousandths(0.1, 0.7) : random.thousandths(0.7, 0.98);
  goal.numbers["reach"] = random.chance(0.2) ? random.thousandths(0.0, 0.02) : random.thousandths(0.05, 2.0);
  goal.numbers["noise"] = random.whole(1, 999999);
  set_if(goal, "bad", random_defect(random));
  set_if(goal, "first", random.chance(0.3) ? 1.0 : 0.0);
  if (random.chance(0.1)) goal.numbers["stamp"] = random.thousandths(-0.3, 2.0);
  if (arm.allow_partial && random.chance(0.5))
    goal.numbers["joints"] = random.whole(1, static_cast<int>(arm.joints.size()));
  return goal;
}

Event random_stream(Random& random, double time) {
  Event stream = event_at(time, "stream");
  stream.numbers["for"] = random.thousandths(0.1, 4.0);
  stream.numbers["period"] = random.pick({0.01, 0.02, 0.04});
  stream.numbers["reach"] = random.thousandths(0.01, 0.3);
  stream.numbers["hertz"] = random.thousandths(0.1, 0.6);
  stream.numbers["noise"] = random.whole(1, 999999);
  set_if(stream, "loss", random.chance(0.4) ? random.thousandths(0.0, 0.3) : 0.0);
  set_if(stream, "late", random.chance(0.4) ? random.thousandths(0.0, 0.03) : 0.0);
  set_if(stream, "velocities", random.chance(0.5) ? 1.0 : 0.0);
  return stream;
}

/// An order that is neither goal nor stream; switching off is followed by switching on, most times.
void add_other_order(Random& random, double time, Script& script) {
  const char* verb = random.pick({"cancel", "cancel", "cancel", "stop", "stop", "halt", "halt", "clear",
                                  "enable", "disable", "disable", "reset"});
  script.events.push_back(event_at(time, verb));
  if (verb == std::string("disable") && random.chance(0.9))
    script.events.push_back(event_at(time + random.thousandths(0.0, 1.5), "enable"));
}

void add_order(Random& random, const Arm& arm, double time, Script& script) {
  const double which = random.number(0.0, 1.0);
  if (which < 0.6) {
    script.events.push_back(random_goal(random, arm, time));
  } else if (which < 0.75) {
    script.events.push_back(random_stream(random, time));
  } else {
    add_other_order(random, time, script);
  }
}

/// A lateness that nobody may notice.
void add_small_absence(Random& random, const Arm& arm, double time, Script& script) {
  Event late = event_at(time, "late");
  late.numbers["for"] = random.thousandths(0.001, arm.tolerated_absence());
  script.events.push_back(late);
}

FaultKinds random_fault_kinds(Random& random) {
  FaultKinds kinds;
  if (random.chance(0.5)) return kinds;
  const int which = random.whole(0, 9);
  kinds.host = which < 3 || which == 9;
  kinds.buses = (which >= 3 && which < 6) || which == 9;
  kinds.drives = which >= 6;
  return kinds;
}

void add_events(Random& random, const Arm& arm, Script& script) {
  const FaultKinds faults = random_fault_kinds(random);
  const double end = random.chance(0.4) ? random.number(2.0, 6.0) : random.number(6.0, 18.0);
  if (!arm.enable_on_start && random.chance(0.95)) script.events.push_back(event_at(0.0, "enable"));
  double time = random.thousandths(0.0, 0.5);
  while (time < end) {
    if (faults.any() && random.chance(0.25)) {
      add_random_fault(random, arm, faults, time, script);
    } else if (random.chance(0.08)) {
      add_small_absence(random, arm, time, script);
    } else {
      add_order(random, arm, time, script);
    }
    time += random.chance(0.3) ? random.thousandths(0.001, 0.4) : random.thousandths(0.3, 3.0);
  }
}

/// Some hosts take their time to plan. Drawn apart from all else, so that a seed means what it meant before
/// there were any.
void let_planning_take_time(std::uint64_t seed, Script& script) {
  constexpr std::uint64_t kApart = 0x9E3779B97F4A7C15U;
  Random random(seed ^ kApart);
  if (random.chance(0.65)) return;
  const double longest = random.pick({0.01, 0.1, 0.6});
  for (Event& event : script.events) {
    if (event.verb == "goal") event.numbers["plan"] = random.thousandths(0.001, longest);
  }
}

/// In some histories goals are paused and gone along at other speeds; at the end as they were sent. Drawn
/// apart, too.
void change_speeds(std::uint64_t seed, Script& script) {
  constexpr std::uint64_t kApart = 0xD1B54A32D192ED03U;
  Random random(seed ^ kApart);
  if (random.chance(0.7) || script.events.empty()) return;
  const double end = script.events.back().time + 1.0;
  const auto add = [&script](double time, double rate, bool paused) {
    Event speed = event_at(time, "speed");
    speed.numbers["override"] = rate;
    speed.numbers["paused"] = paused ? 1.0 : 0.0;
    script.events.push_back(speed);
  };
  for (int changes = random.whole(1, 8); changes > 0; --changes) {
    const double rate = random.chance(0.1) ? 0.0 : random.thousandths(0.2, 2.0);
    add(random.thousandths(0.0, end), rate, random.chance(0.3));
  }
  add(end, 1.0, false);
}

}  // namespace

Script random_script(std::uint64_t seed, const std::string& kind) {
  Random random(seed);
  Script script;
  const auto& kinds = arm_kinds();
  const std::string& drawn = kinds[random.next() % kinds.size()];
  script.configuration = random_arm(random, kind.empty() ? drawn : kind);
  script.at_once = random.chance(0.1);
  add_events(random, read_arm(script.configuration), script);
  let_planning_take_time(seed, script);
  change_speeds(seed, script);
  // A script's time is written in thousandths, so that its text is the script.
  for (Event& event : script.events)
    event.time = static_cast<double>(static_cast<long>(event.time * 1000.0)) / 1000.0;
  std::stable_sort(script.events.begin(), script.events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  return script;
}

}  // namespace interpolated_motion::simulation
