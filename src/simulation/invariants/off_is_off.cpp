#include "simulation/invariants/off_is_off.h"

#include <fmt/format.h>

namespace interpolated_motion::simulation {

namespace {

/// s: what is told to a drive within this time of a fault of its bus, or of its own silence, may not get
/// there.
constexpr double kOutOfReach = 10.0;

/// Of a drive that goes on hearing and answering.
bool leaves_reachable(const std::string& command) {
  for (const char* harmless : {"emcy", "stall", "fault ", "clock"}) {
    if (command.rfind(harmless, 0) == 0) return true;
  }
  return false;
}

}  // namespace

bool OffIsOff::is_reachable(std::size_t joint) const {
  bool reachable = true;
  for (const FaultEntry& fault : ledger().faults()) {
    const bool meant = fault.target == arm().joints[joint].name || fault.target == arm().joints[joint].bus;
    if (!meant || leaves_reachable(fault.command)) continue;
    if (fault.command == "silence 1") reachable = false;
    if (fault.command == "silence 0") reachable = true;
    if (seconds(asked_ - fault.time) < kOutOfReach) return false;
  }
  return reachable;
}

void OffIsOff::request_ended(const RequestEntry& request) {
  if (request.verb == "disable") asked_ = request.made;
}

void OffIsOff::look(const Look& look) {
  if (asked_ == kNever || look.powers == nullptr || ledger().is_dead()) return;
  if (ledger().has_request_since("enable", asked_)) {
    asked_ = kNever;
    return;
  }
  for (std::size_t i = 0; i < look.powers->size(); ++i) {
    if (!(*look.powers)[i] || !is_reachable(i)) continue;
    fail(fmt::format("{} has power though it was to be switched off, and that was answered",
                     arm().joints[i].label()));
  }
}

}  // namespace interpolated_motion::simulation
