#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/emergency_producer.h"
#include "interpolated_motion_driver/emulation/canopen/motion_clock.h"
#include "interpolated_motion_driver/emulation/canopen/nmt_slave.h"
#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/canopen/pdo_engine.h"

namespace interpolated_motion::emulation {

/// What the objects of the communication profile area, 0x1000..0x1FFF, mean to a node (CiA 301): PDO
/// parameters, error history, heartbeat and node guarding.
class CommunicationObjects {
 public:
  /// Works on what it is given, which must outlive it. Periods count on `clock`.
  CommunicationObjects(ObjectDictionary& objects, NmtSlave& nmt, PdoEngine& pdo,
                       EmergencyProducer& emergencies, const MotionClock& clock)
      : objects_(objects), nmt_(nmt), pdo_(pdo), emergencies_(emergencies), clock_(clock) {}

  /// Whether CiA 301 has rules for writing the object that go beyond type and range.
  static bool rules(std::uint16_t index);

  /// Whether `value` may be written to an object that it rules.
  AbortCode check(ObjectDictionary::Slot slot, std::int64_t value) const;

  /// An object has been written: what follows from it. False when it means nothing to the node itself.
  bool written(const ObjectEntry& entry, std::int64_t value);

  /// All of them have been changed by other ways than writing them.
  void apply();

  /// NMT resets the communication: they get their values of `initial`, which is of all objects.
  void restore(const ObjectDictionary::Values& initial);

 private:
  ObjectDictionary& objects_;
  NmtSlave& nmt_;
  PdoEngine& pdo_;
  EmergencyProducer& emergencies_;
  const MotionClock& clock_;
};

}  // namespace interpolated_motion::emulation
