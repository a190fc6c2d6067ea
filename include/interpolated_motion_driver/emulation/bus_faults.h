#pragma once

#include <vector>

#include "interpolated_motion_driver/emulation/fault_command.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// `drop COUNT` (the next COUNT frames reach nobody), `drop_id ID COUNT` (the next COUNT frames with that
/// identifier), `drop_nth N` (the N-th frame), `refuse_nth N` (the host's N-th attempt to send), `disconnect
/// 0|1` (the host's plug is out), `bus_off SECONDS`, `repeat_id ID COUNT` (the next COUNT frames with that
/// identifier come twice, as if from two devices), `send FRAME` (another node sends it: `send 000#8002`), all
/// from `now` on.
std::vector<FaultCommand> faults_of(transport::VirtualCanBus& bus, HostTime now);

/// `lose_requests COUNT`, `lose_replies COUNT` (the next COUNT characters towards or from the drives reach
/// nobody), `garble_requests COUNT`, `garble_replies COUNT` (they arrive wrong), `garbage TEXT` (the host
/// receives what nobody has sent), `lose_request N`, `lose_reply N` (the N-th text reaches nobody),
/// `refuse_nth N` (the host's N-th attempt to send), `disconnect 0|1`, all from `now` on.
std::vector<FaultCommand> faults_of(transport::VirtualSerialLine& line, HostTime now);

}  // namespace interpolated_motion::emulation
