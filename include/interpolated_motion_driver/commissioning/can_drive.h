#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/can_session.h"
#include "interpolated_motion_driver/commissioning/drive_access.h"
#include "interpolated_motion_driver/commissioning/object_value.h"

namespace interpolated_motion::commissioning {

/// A drive on CANopen: its object dictionary.
class CanDrive : public DriveAccess {
 public:
  /// `node`: 1..127. `eds`: for names, types and ranges; without it all objects can be read and written, but
  /// parameters() does not know them. `session` must outlive this.
  CanDrive(CanSession& session, std::uint8_t node, std::optional<canopen::Eds> eds);

  Result<DriveIdentity> identity() override;
  Result<Shown> show(const std::string& name) override;
  Result<Change> prepare(const std::string& name, const std::string& value) override;
  Failure apply(const Change& change) override;
  Failure save() override;
  Result<std::vector<Parameter>> parameters(const Progress& progress) override;
  Result<std::vector<Change>> differences(const std::vector<Parameter>& wanted,
                                          const Progress& progress) override;
  Failure why_not_restore() override;
  std::vector<std::string> restore(const std::vector<Parameter>& wanted,
                                   const std::vector<Change>& changes) override;

 private:
  const canopen::Eds* eds() const { return eds_ ? &*eds_ : nullptr; }
  Failure write(const NamedObject& object, const std::string& value, std::size_t size);

  CanSession& session_;
  std::uint8_t node_;
  std::optional<canopen::Eds> eds_;
};

/// Whether an object is a parameter, which keeps what is written: neither a command (0x6040, 0x1010) nor a
/// setpoint (0x607A, 0x20C1) nor a history.
bool is_parameter(const canopen::EdsObject& object);

/// The writes that make `wanted` of a drive with `changes`: those of a PDO in the order that CiA 301 (1400h,
/// 1600h) demands, with the PDO invalid meanwhile; the others as they come.
std::vector<Parameter> restore_order(const std::vector<Parameter>& wanted,
                                     const std::vector<Change>& changes);

}  // namespace interpolated_motion::commissioning
