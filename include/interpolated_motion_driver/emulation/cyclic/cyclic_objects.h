#pragma once

#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_object_table.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"

namespace interpolated_motion::emulation {

/// The object dictionary of an emulated cyclic servo drive.
class CyclicObjects : public ObjectDictionary {
 public:
  explicit CyclicObjects(const CyclicParameters& parameters)
      : ObjectDictionary(kCyclicTable, parameters.node_id) {
    preset(0x1018, 1, parameters.vendor_id);
    preset(0x1018, 2, parameters.product_code);
    preset(0x1018, 3, parameters.revision_number);
    preset(0x1018, 4, parameters.serial_number);
    preset(0x2100, 1, parameters.interpolation_order);
    preset(0x2100, 2, parameters.ride_through);
  }
};

}  // namespace interpolated_motion::emulation
