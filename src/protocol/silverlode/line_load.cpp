#include "interpolated_motion_driver/protocol/silverlode/line_load.h"

#include <algorithm>

namespace interpolated_motion::silverlode {

void LineLoad::add(HostTime begin, HostTime end) {
  begin = std::max(begin, end - kSlots * kSlot);
  while (begin < end) {
    const std::int64_t number = begin.time_since_epoch() / kSlot;
    const HostTime until = std::min(end, HostTime{kSlot * (number + 1)});
    add_to_slot(number, until - begin);
    begin = until;
  }
}

void LineLoad::add_to_slot(std::int64_t number, HostDuration taken) {
  Slot& slot = slots_[static_cast<std::uint64_t>(number) % kSlots];
  if (number < slot.number) return;
  if (number > slot.number) slot = {number, HostDuration::zero()};
  slot.taken += taken;
}

double LineLoad::load(HostTime now) const {
  const std::int64_t newest = now.time_since_epoch() / kSlot;
  HostDuration taken{};
  for (const Slot& slot : slots_) {
    if (slot.number > newest - kSlots && slot.number <= newest) taken += slot.taken;
  }
  const HostTime begin{kSlot * (newest - kSlots + 1)};
  return std::min(1.0, seconds(taken) / seconds(now - begin));
}

}  // namespace interpolated_motion::silverlode
