#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/commissioning/parameter_file.h"
#include "interpolated_motion_driver/commissioning/progress.h"
#include "interpolated_motion_driver/units/expected.h"

namespace interpolated_motion::commissioning {

/// A value that is to be written.
struct Change {
  std::string title;  ///< "0x6065:00 Max Following Error"
  std::string unit;   ///< may be empty
  Parameter before;   ///< as the drive has it now
  std::string after;  ///< the value it is to have, decimal

  /// "0x6065:00 Max Following Error: 2000 -> 4000 position units".
  std::string text() const;
};

/// A value in a line for the user.
struct Shown {
  std::string text;
};

/// One drive and its parameters, whatever its kind. Failures are sentences for the user.
class DriveAccess {
 public:
  template <class Value>
  using Result = Expected<Value, std::string>;
  using Failure = std::optional<std::string>;

  virtual ~DriveAccess() = default;

  /// Which drive it is.
  virtual Result<DriveIdentity> identity() = 0;
  /// A parameter or value, by number or name, in a line: title, value, unit, type, default, range.
  virtual Result<Shown> show(const std::string& name) = 0;
  /// What a write would change. Nothing is written; refused is what can be told beforehand: no such name, a
  /// value out of range, read-only.
  virtual Result<Change> prepare(const std::string& name, const std::string& value) = 0;
  /// Writes it, and reads back whether the drive has it.
  virtual Failure apply(const Change& change) = 0;
  /// Lets the drive keep its parameters without power.
  virtual Failure save() = 0;

  /// All parameters of the drive: what a host can write and read again, without commands and setpoints.
  virtual Result<std::vector<Parameter>> parameters(const Progress& progress) = 0;
  /// What the drive has in which it differs from `wanted`, in the order of `wanted`.
  virtual Result<std::vector<Change>> differences(const std::vector<Parameter>& wanted,
                                                  const Progress& progress) = 0;
  /// Why nothing must be restored now, such as an enabled drive; empty when it may.
  virtual Failure why_not_restore() = 0;
  /// Writes what differs from `wanted`, in an order the drive takes it. The sentences of what was refused.
  virtual std::vector<std::string> restore(const std::vector<Parameter>& wanted,
                                           const std::vector<Change>& changes) = 0;
};

}  // namespace interpolated_motion::commissioning
