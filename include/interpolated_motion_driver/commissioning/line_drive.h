#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/drive_access.h"
#include "interpolated_motion_driver/commissioning/line_session.h"

namespace interpolated_motion::commissioning {

/// A SilverLode drive: its registers.
class LineDrive : public DriveAccess {
 public:
  /// `address`: 1..254. `session` must outlive this.
  LineDrive(LineSession& session, std::uint8_t address) : session_(session), address_(address) {}

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
  Result<std::int32_t> read(std::uint16_t number);

  LineSession& session_;
  std::uint8_t address_;
};

}  // namespace interpolated_motion::commissioning
