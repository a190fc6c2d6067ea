#include "interpolated_motion_driver/hardware/drive_kind.h"

#include <variant>

// That a drive is on a bus of its kind's type has been checked with the configuration.
namespace interpolated_motion::hardware {

std::unique_ptr<axis::Axis> CanDriveKind::make_axis(const DriveConfiguration& drive, const Configuration& all,
                                                    BusLink& link) const {
  return make_axis_on(dynamic_cast<CanLink&>(link), drive, all);
}

emulation::Drive& CanDriveKind::make_emulated(const DriveConfiguration& drive, emulation::World& world,
                                              EmulatedBus bus) const {
  return make_emulated_on(*std::get<transport::VirtualCanBus*>(bus), drive, world);
}

std::unique_ptr<axis::Axis> LineDriveKind::make_axis(const DriveConfiguration& drive,
                                                     const Configuration& all, BusLink& link) const {
  return make_axis_on(dynamic_cast<SerialLink&>(link), drive, all);
}

emulation::Drive& LineDriveKind::make_emulated(const DriveConfiguration& drive, emulation::World& world,
                                               EmulatedBus bus) const {
  return make_emulated_on(*std::get<transport::VirtualSerialLine*>(bus), drive, world);
}

}  // namespace interpolated_motion::hardware
