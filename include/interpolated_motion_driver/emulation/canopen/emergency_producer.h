#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/error_store.h"
#include "interpolated_motion_driver/emulation/canopen/nmt_slave.h"
#include "interpolated_motion_driver/emulation/canopen/node_port.h"
#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// EMCY messages of a node, and its errors in 0x1001 and 0x1003 (CiA 301, 7.2.7). Messages go out under the
/// COB-ID of 0x1014, unless that is invalid, the node is stopped or still initialising.
class EmergencyProducer {
 public:
  /// Works on what it is given, which must outlive it. `objects` have the objects named above.
  EmergencyProducer(ObjectDictionary& objects, const NmtSlave& nmt, NodePort& port)
      : objects_(objects), nmt_(nmt), port_(port) {}

  /// After boot: no error. Nothing is sent, and the objects are left to publish().
  void restart() { errors_ = ErrorStore(); }

  /// An error: its code, and its bits of 0x1001.
  void raise(std::uint16_t code, std::uint8_t error_register, HostTime now);

  /// All errors are gone: the message "error reset".
  void reset(HostTime now);

  /// 0x1003:0 was set to 0.
  void clear_history();

  /// Brings 0x1001 and 0x1003 up to date.
  void publish();

  /// Errors raised so far, whether their messages were sent or not.
  std::uint64_t raised() const { return raised_; }

 private:
  void send(const EmergencyBytes& bytes, HostTime now);

  ObjectDictionary& objects_;
  const NmtSlave& nmt_;
  NodePort& port_;
  ErrorStore errors_;
  std::uint64_t raised_ = 0;
};

}  // namespace interpolated_motion::emulation
