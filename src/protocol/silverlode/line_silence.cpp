#include "interpolated_motion_driver/protocol/silverlode/line_silence.h"

#include <fmt/format.h>

namespace interpolated_motion::silverlode {

HostDuration longest_silence(const LineParameters& parameters) {
  const int attempts = parameters.repeats + 1;
  return (attempts + 1) * (parameters.reply_timeout + parameters.guard);
}

std::string silence_text(const LineMaster& line) {
  for (int address = 1; address <= kMaxAddress; ++address) {
    const DeviceLink* const device = line.find_device(static_cast<std::uint8_t>(address));
    if (device == nullptr || device->statistics().timeouts_in_a_row == 0) continue;
    return fmt::format(
        "; {} does not answer, and each question to it takes {:.3f} s of the line (reply_timeout)",
        device->name(), seconds(line.parameters().reply_timeout));
  }
  return {};
}

}  // namespace interpolated_motion::silverlode
