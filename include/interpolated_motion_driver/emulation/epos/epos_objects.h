#pragma once

#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/epos/epos_object_table.h"
#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"

namespace interpolated_motion::emulation {

/// The object dictionary of an emulated EPOS drive. `parameters` must outlive it.
class EposObjects : public ObjectDictionary {
 public:
  /// With the defaults of the EDS and those that `parameters` give.
  explicit EposObjects(const EposParameters& parameters);

  bool mappable(Slot slot, bool into_receive_pdo) const override;

 private:
  bool hidden(std::uint16_t index) const override;
  AbortCode check_range(Slot slot, std::int64_t value) const override;
  /// How many of the unit of 0x608B make an rpm.
  std::int64_t notation_scale() const;

  const EposParameters& parameters_;
};

}  // namespace interpolated_motion::emulation
