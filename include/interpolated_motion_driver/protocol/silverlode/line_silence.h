#pragma once

#include <string>

#include "interpolated_motion_driver/protocol/silverlode/line_master.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// What a device that has fallen silent takes of the line until that is known: each of its attempts waits for
/// `reply_timeout` and `guard`, and one more may have begun before.
HostDuration longest_silence(const LineParameters& parameters);

/// `; line0 address 17 does not answer, and each question to it takes 0.200 s of the line (reply_timeout)`;
/// empty when all devices have answered the last time they were asked.
std::string silence_text(const LineMaster& line);

}  // namespace interpolated_motion::silverlode
