#pragma once

#include "fuzz/support/fuzz_input.h"
#include "fuzz/support/fuzzed_driver.h"

namespace interpolated_motion::fuzz {

/// An order that one byte names: a goal of 0.1 s to 0.3 s, a cancel, or a request.
inline void give_order(FuzzInput& input, FuzzedDriver& arm) {
  const unsigned which = input.below(FuzzedDriver::kOrders + 4);
  if (which < FuzzedDriver::kOrders) return arm.order(static_cast<FuzzedDriver::Order>(which));
  if (which == FuzzedDriver::kOrders) return arm.cancel();
  arm.move(0.02, 0.1 * (which - FuzzedDriver::kOrders));
}

}  // namespace interpolated_motion::fuzz
