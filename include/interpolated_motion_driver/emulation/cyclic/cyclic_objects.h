#pragma once

#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_object_table.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"

namespace interpolated_motion::emulation {

/// The object dictionary of an emulated cyclic servo drive.
class CyclicObjects : public ObjectDictionary {
 public:
  explicit CyclicObjects(const CyclicParameters& parameters)
      : ObjectDictionary(kCyclicTable, parameters.node_id), takes_offsets_(parameters.takes_offsets) {
    preset(0x1018, 1, parameters.vendor_id);
    preset(0x1018, 2, parameters.product_code);
    preset(0x1018, 3, parameters.revision_number);
    preset(0x1018, 4, parameters.serial_number);
    preset(0x2100, 1, parameters.interpolation_order);
    preset(0x2100, 2, parameters.ride_through);
  }

  bool mappable(Slot slot, bool into_receive_pdo) const override {
    const std::uint16_t index = entry(slot).index;
    const bool offset = index == 0x60B1 || index == 0x60B2;
    return (takes_offsets_ || !offset) && ObjectDictionary::mappable(slot, into_receive_pdo);
  }

 private:
  bool takes_offsets_;
};

}  // namespace interpolated_motion::emulation
