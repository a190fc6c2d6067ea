#pragma once

#include <algorithm>
#include <iterator>

#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::cia402 {

struct ObjectName {
  canopen::ObjectAddress address;
  const char* name;
};

/// The name of an object in a table that ascends by address; empty when it is not there.
template <std::size_t size>
const char* find_name(const ObjectName (&names)[size], canopen::ObjectAddress address) {
  const auto* found =
      std::lower_bound(std::begin(names), std::end(names), address,
                       [](const ObjectName& entry, canopen::ObjectAddress a) { return entry.address < a; });
  return found != std::end(names) && found->address == address ? found->name : "";
}

}  // namespace interpolated_motion::cia402
