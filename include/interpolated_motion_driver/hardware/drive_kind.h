#pragma once

#include <memory>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/emulation/drive.h"
#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/can_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "interpolated_motion_driver/hardware/emulated_bus.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"
#include "interpolated_motion_driver/hardware/serial_link.h"

namespace interpolated_motion::hardware {

/// A kind of drive: all that the driver has to know of it in order to configure, to move and to emulate such
/// drives. Each kind is one object in a folder of its own, `hardware/<kind>/`, that never changes, and is in
/// the list of drive_kinds.cpp; nothing else names a kind. A kind derives from CanDriveKind or LineDriveKind.
/// How to add one: docs/architecture.md.
class DriveKind {
 public:
  virtual ~DriveKind() = default;

  /// How `drives/<joint>/type` calls it: "epos_ipm".
  virtual const char* name() const = 0;
  /// How people call its drives: "EPOS2".
  virtual const char* product() const = 0;
  /// Of the buses that its drives can be on.
  virtual BusType bus_type() const = 0;

  /// What `deviation_bound` is where the configuration does not say, counts, 0.6..1000.
  virtual double default_deviation_bound() const = 0;
  /// Whether its drives have no clock of their own for their motion but follow SYNC, that is the host's time.
  /// A bus with such a drive is isochronous.
  virtual bool follows_host_time() const { return false; }
  /// Whether motion records for its drives are sent ahead, for which the bus keeps its `max_load` free.
  virtual bool sends_records() const { return false; }
  /// On CANopen: bits that host and `drive`, one of this kind, exchange at each SYNC, whether anything moves
  /// or not, at most; of what is sent more seldom its share.
  virtual double bits_per_sync(const DriveConfiguration& /*drive*/, const BusConfiguration& /*bus*/) const {
    return 0.0;
  }

  /// Reads what only drives of this kind have in `drives/<joint>`, and in its `emulation`. `drive` holds what
  /// all drives have already. Never returns null. Throws like ParameterReader.
  virtual std::shared_ptr<const DriveSettings> parse(ParameterReader& reader, ParameterReader& emulation,
                                                     const DriveConfiguration& drive) const = 0;
  /// Whether a drive of this kind goes together with its bus, which is of the right type, and with the other
  /// drives. Throws std::invalid_argument that names the parameter, its value and what to do.
  virtual void check(const DriveConfiguration& /*drive*/, const Configuration& /*all*/) const {}

  /// The axis of a drive, with what it needs of `link`, the drive's bus. Both `link` and what it is asked for
  /// live longer than the axis. Never null.
  virtual std::unique_ptr<axis::Axis> make_axis(const DriveConfiguration& drive, const Configuration& all,
                                                BusLink& link) const = 0;
  /// An emulated drive with the drive's settings, switched on now, on `bus` of `world`, which owns it. Throws
  /// std::invalid_argument, as World::add().
  virtual emulation::Drive& make_emulated(const DriveConfiguration& drive, emulation::World& world,
                                          EmulatedBus bus) const = 0;
};

/// A kind of drive on CANopen.
class CanDriveKind : public DriveKind {
 public:
  /// As DriveKind. Throws std::bad_cast or std::bad_variant_access where link or bus is of the other type:
  /// Configuration has seen to it that none is.
  BusType bus_type() const final { return BusType::Canopen; }
  std::unique_ptr<axis::Axis> make_axis(const DriveConfiguration& drive, const Configuration& all,
                                        BusLink& link) const final;
  emulation::Drive& make_emulated(const DriveConfiguration& drive, emulation::World& world,
                                  EmulatedBus bus) const final;

 private:
  /// As make_axis().
  virtual std::unique_ptr<axis::Axis> make_axis_on(CanLink& link, const DriveConfiguration& drive,
                                                   const Configuration& all) const = 0;
  /// As make_emulated().
  virtual emulation::Drive& make_emulated_on(transport::VirtualCanBus& bus, const DriveConfiguration& drive,
                                             emulation::World& world) const = 0;
};

/// A kind of drive on a serial line with SilverLode's protocol.
class LineDriveKind : public DriveKind {
 public:
  /// As CanDriveKind, for the other type.
  BusType bus_type() const final { return BusType::Silverlode; }
  std::unique_ptr<axis::Axis> make_axis(const DriveConfiguration& drive, const Configuration& all,
                                        BusLink& link) const final;
  emulation::Drive& make_emulated(const DriveConfiguration& drive, emulation::World& world,
                                  EmulatedBus bus) const final;

 private:
  /// As make_axis().
  virtual std::unique_ptr<axis::Axis> make_axis_on(SerialLink& link, const DriveConfiguration& drive,
                                                   const Configuration& all) const = 0;
  /// As make_emulated().
  virtual emulation::Drive& make_emulated_on(transport::VirtualSerialLine& line,
                                             const DriveConfiguration& drive,
                                             emulation::World& world) const = 0;
};

}  // namespace interpolated_motion::hardware
