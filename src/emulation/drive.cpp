#include "interpolated_motion_driver/emulation/drive.h"

namespace interpolated_motion::emulation {

std::optional<std::string> Drive::inject(const std::string& command, HostTime now) {
  using Numbers = FaultCommand::Numbers;
  std::vector<FaultCommand> known = own_faults(now);
  known.push_back({"power_cycle", {kFaultSeconds}, [this, now](const Numbers& n) {
                     power_cycle(now, host_duration(n[0]));
                   }});
  known.push_back({"stall", {kFaultSwitch}, [this](const Numbers& n) { stall(n[0] != 0.0); }});
  known.push_back({"silence", {kFaultSwitch}, [this, now](const Numbers& n) { silence(n[0] != 0.0, now); }});
  known.push_back({"clock", {kFaultPpm}, [this](const Numbers& n) { set_clock_error(n[0]); }});
  return obey_fault(command, known);
}

}  // namespace interpolated_motion::emulation
