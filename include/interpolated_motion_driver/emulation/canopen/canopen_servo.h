#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/canopen_node.h"
#include "interpolated_motion_driver/emulation/plant.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// A CANopen node that drives an axis: what CanopenDrive needs of it.
class CanopenServo : public CanopenNode {
 public:
  /// The axis.
  virtual Plant& plant() = 0;
  /// The power stage is on.
  virtual bool has_torque() const = 0;
  /// The drive finds an error: EMCY message with `code` (CiA 301) and bits for 0x1001, and fault reaction.
  virtual void fault(std::uint16_t code, std::uint8_t error_register, HostTime now) = 0;

 protected:
  using CanopenNode::CanopenNode;
};

}  // namespace interpolated_motion::emulation
