#pragma once

#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::fuzz {

/// The emulated buses of a driver, which it keeps to itself; each null until a drive has been emulated on it.
struct Buses {
  transport::VirtualCanBus* can = nullptr;
  transport::VirtualSerialLine* line = nullptr;
};

/// A kind of drive as it is, that besides tells on which bus its drives are emulated.
class TappedKind : public hardware::DriveKind {
 public:
  TappedKind(const hardware::DriveKind& kind, Buses& buses) : kind_(kind), buses_(buses) {}

  const char* name() const override { return kind_.name(); }
  const char* product() const override { return kind_.product(); }
  hardware::BusType bus_type() const override { return kind_.bus_type(); }
  double default_deviation_bound() const override { return kind_.default_deviation_bound(); }
  bool follows_host_time() const override { return kind_.follows_host_time(); }
  bool sends_records() const override { return kind_.sends_records(); }
  double bits_per_sync(const hardware::DriveConfiguration& drive,
                       const hardware::BusConfiguration& bus) const override {
    return kind_.bits_per_sync(drive, bus);
  }
  std::shared_ptr<const hardware::DriveSettings> parse(
      hardware::ParameterReader& reader, hardware::ParameterReader& emulation,
      const hardware::DriveConfiguration& drive) const override {
    return kind_.parse(reader, emulation, drive);
  }
  void check(const hardware::DriveConfiguration& drive, const hardware::Configuration& all) const override {
    kind_.check(drive, all);
  }
  std::unique_ptr<axis::Axis> make_axis(const hardware::DriveConfiguration& drive,
                                        const hardware::Configuration& all,
                                        hardware::BusLink& link) const override {
    return kind_.make_axis(drive, all, link);
  }
  emulation::Drive& make_emulated(const hardware::DriveConfiguration& drive, emulation::World& world,
                                  hardware::EmulatedBus bus) const override {
    if (auto* const* can = std::get_if<transport::VirtualCanBus*>(&bus)) buses_.can = *can;
    if (auto* const* line = std::get_if<transport::VirtualSerialLine*>(&bus)) buses_.line = *line;
    return kind_.make_emulated(drive, world, bus);
  }

 private:
  const hardware::DriveKind& kind_;
  Buses& buses_;
};

}  // namespace interpolated_motion::fuzz
