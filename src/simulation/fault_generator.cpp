#include "simulation/fault_generator.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

void inject(Script& script, double time, std::string target, std::string command) {
  Event event;
  event.time = time;
  event.verb = "inject";
  event.target = std::move(target);
  event.command = std::move(command);
  script.events.push_back(std::move(event));
}

void order(Script& script, double time, const std::string& verb) {
  Event event;
  event.time = time;
  event.verb = verb;
  script.events.push_back(std::move(event));
}

/// `command` 1 now, and 0 after a while.
void inject_for_a_while(Random& random, Script& script, double time, const std::string& target,
                        const std::string& command) {
  inject(script, time, target, command + " 1");
  inject(script, time + random.thousandths(0.02, 2.0), target, command + " 0");
}

void add_host_fault(Random& random, double time, Script& script) {
  Event event;
  event.time = time;
  event.verb = random.chance(0.15) ? "die" : "late";
  if (event.verb == "late")
    event.numbers["for"] = random.chance(0.7) ? random.thousandths(0.005, 0.3) : random.thousandths(0.3, 3.0);
  script.events.push_back(event);
}

std::string random_identifier(Random& random, const Arm& arm, const std::string& bus) {
  const auto base =
      random.pick({0x080, 0x180, 0x200, 0x280, 0x300, 0x380, 0x400, 0x480, 0x500, 0x580, 0x600, 0x700});
  int node = 0;
  for (std::size_t i = 0; i < arm.joints.size(); ++i)
    if (arm.joints[i].bus == bus && (node == 0 || random.chance(0.5))) node = static_cast<int>(i) + 1;
  return fmt::format("{:#05x}", base + (base == 0x080 && random.chance(0.7) ? 0 : node));
}

void add_can_fault(Random& random, const Arm& arm, const std::string& bus, double time, Script& script) {
  switch (random.whole(0, 3)) {
    case 0:
      return inject(script, time, bus, fmt::format("drop {}", random.whole(1, 8)));
    case 1:
      return inject(script, time, bus,
                    fmt::format("drop_id {} {}", random_identifier(random, arm, bus), random.whole(1, 4)));
    case 2:
      return inject_for_a_while(random, script, time, bus, "disconnect");
    default:
      return inject(script, time, bus, fmt::format("bus_off {}", random.thousandths(0.01, 1.0)));
  }
}

void add_line_fault(Random& random, const std::string& bus, double time, Script& script) {
  switch (random.whole(0, 4)) {
    case 0:
      return inject(script, time, bus, fmt::format("lose_requests {}", random.whole(1, 20)));
    case 1:
      return inject(script, time, bus, fmt::format("lose_replies {}", random.whole(1, 20)));
    case 2:
      return inject(script, time, bus,
                    fmt::format("{} {}", random.pick<std::string>({"garble_requests", "garble_replies"}),
                                random.whole(1, 10)));
    case 3:
      return inject(script, time, bus,
                    "garbage " + random.pick<std::string>({"* 01", "! 10 000A 5", "xyz", "# 10"}));
    default:
      return inject_for_a_while(random, script, time, bus, "disconnect");
  }
}

void add_bus_fault(Random& random, const Arm& arm, double time, Script& script) {
  const Joint& joint = arm.joints[random.next() % arm.joints.size()];
  if (joint.kind == "silverlode_ims") return add_line_fault(random, joint.bus, time, script);
  add_can_fault(random, arm, joint.bus, time, script);
}

/// What only drives of one protocol have.
std::string random_error(Random& random, const Joint& joint) {
  if (joint.kind != "silverlode_ims")
    return "emcy " + random.pick<std::string>({"0x2310", "0x3210", "0x4210", "0x8611", "0x7320"});
  if (random.chance(0.3)) {
    return fmt::format("nak {} {} {}", random.pick({0, 25, 25, 12, 252, 253}), random.whole(1, 6),
                       random.whole(1, 3));
  }
  return "fault " + random.pick<std::string>(
                        {"over_temperature", "over_voltage", "low_voltage", "moving_error", "holding_error"});
}

void add_drive_fault(Random& random, const Arm& arm, double time, Script& script) {
  const Joint& joint = arm.joints[random.next() % arm.joints.size()];
  switch (random.whole(0, 4)) {
    case 0:
      return inject(script, time, joint.name, random_error(random, joint));
    case 1:
      return inject(script, time, joint.name, fmt::format("power_cycle {}", random.thousandths(0.02, 1.5)));
    case 2:
      return inject_for_a_while(random, script, time, joint.name, "stall");
    case 3:
      return inject_for_a_while(random, script, time, joint.name, "silence");
    default:
      return inject(script, time, joint.name, fmt::format("clock {}", random.whole(-300, 300)));
  }
}

void add_recovery(Random& random, double time, Script& script) {
  double when = time + random.thousandths(0.2, 4.0);
  order(script, when, "reset");
  when += random.thousandths(0.1, 2.0);
  order(script, when, "enable");
}

}  // namespace

void add_random_fault(Random& random, const Arm& arm, const FaultKinds& kinds, double time, Script& script) {
  const int which = random.whole(0, 2);
  const bool of_host = (which == 0 && kinds.host) || (!kinds.drives && !kinds.buses);
  if (of_host) {
    add_host_fault(random, time, script);
  } else if (kinds.drives && (which == 1 || !kinds.buses)) {
    add_drive_fault(random, arm, time, script);
  } else {
    add_bus_fault(random, arm, time, script);
  }
  if (random.chance(0.8)) add_recovery(random, time, script);
}

}  // namespace interpolated_motion::simulation
