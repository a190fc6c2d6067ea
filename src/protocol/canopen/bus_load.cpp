#include "interpolated_motion_driver/protocol/canopen/bus_load.h"

#include <algorithm>

namespace interpolated_motion::canopen {
namespace {

constexpr unsigned kInterframeSpace = 3;

struct Bits {
  unsigned total;    ///< with the pause behind, without stuff bits
  unsigned stuffed;  ///< those of them that take part in stuffing
};

/// ISO 11898-1: start bit to end of frame is 44 bits and the data with an 11-bit identifier, 64 with one of
/// 29 bits; the last 10 of them (CRC delimiter, acknowledge, end of frame) are not stuffed.
Bits count_bits(const Frame& frame) {
  const unsigned data = frame.remote ? 0 : 8u * std::min<unsigned>(frame.length, 8);
  const unsigned sent = (frame.extended ? 64u : 44u) + data;
  return {sent + kInterframeSpace, sent - 10};
}

}  // namespace

unsigned worst_case_bits(const Frame& frame) {
  const Bits bits = count_bits(frame);
  return bits.total + (bits.stuffed - 1) / 4;
}

double average_bits(const Frame& frame) {
  const Bits bits = count_bits(frame);
  return bits.total + bits.stuffed / 13.0;
}

void BusLoad::add(const Frame& frame, HostTime time) {
  const std::int64_t number = time.time_since_epoch() / kSlot;
  Slot& slot = slots_[static_cast<std::uint64_t>(number) % kSlots];
  if (number < slot.number) return;
  if (number > slot.number) slot = {number, 0};
  slot.bits += average_bits(frame);
}

double BusLoad::load(HostTime now) const {
  const std::int64_t newest = now.time_since_epoch() / kSlot;
  double bits = 0;
  for (const Slot& slot : slots_) {
    if (slot.number > newest - kSlots && slot.number <= newest) bits += slot.bits;
  }
  const HostTime begin{kSlot * (newest - kSlots + 1)};
  return bits / (seconds(now - begin) * bitrate_);
}

}  // namespace interpolated_motion::canopen
